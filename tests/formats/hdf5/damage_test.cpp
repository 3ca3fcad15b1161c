// SPDX-License-Identifier: GPL-3.0-or-later
// Files whose bytes were changed after they were written: the same contents come out, or an error that names the file.
#include <fstream>
#include <functional>
#include <random>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "common/error.hpp"
#include "formats/companion/companion.hpp"
#include "formats/modal_body/modal_body.hpp"
#include "formats/results/checkpoint.hpp"
#include "formats/results/results.hpp"
#include "formats/superelement/superelement.hpp"
#include "tests/support/bodies/beam_superelement.hpp"
#include "tests/support/bodies/lumped_bodies.hpp"
#include "tests/support/bodies/second_order_network.hpp"
#include "tests/support/results_rows.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/trials.hpp"

namespace tisserand::formats::damage_test {
namespace {

std::string bits(const double* values, std::size_t count) {
  return std::string(reinterpret_cast<const char*>(values), count * sizeof(double));
}
template <typename Matrix>
std::string bits(const Matrix& m) {
  return bits(m.data(), static_cast<std::size_t>(m.size()));
}
std::string text(const std::string& value) { return value + '\n'; }
std::string text(const Units& u) {
  std::string all;
  for (const Unit& unit : {u.length, u.mass, u.time}) all += fmt::format("{} {}\n", unit.factor, unit.label);
  return all;
}

struct Kind {
  const char* name;
  void (*write)(const std::string& path);
  std::string (*read)(const std::string& path);  ///< all that the file says
};
void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.name; }

void write_results(const std::string& path) {
  const ResultsLayout layout = test_support::example_layout();
  ResultsWriter writer(path, layout);
  ResultsRow row;
  row.resize(layout);
  for (int t = 0; t < 700; ++t) {
    test_support::fill_row(t, row);
    writer.append(row);
  }
  writer.finish(true, "", R"({"steps": 700})");
}

std::string read_results(const std::string& path) {
  const ResultsReader reader(path);
  std::string all = text(reader.scene()) + text(reader.run()) + text(reader.reason()) + text(reader.report_json());
  std::vector<std::string> names;
  for (const Channel& channel : reader.channels()) {
    names.push_back(channel.name);
    all += channel.name + " " + channel.unit + "\n";
  }
  return all + bits(reader.read_rows(names, 0, reader.rows()));
}

void write_element(const std::string& path) {
  Superelement element = test_support::craig_bampton_beam({}, 18);  // matrices of several kilobytes
  write_superelement(path, element);
}

std::string read_element(const std::string& path) {
  const Superelement e = read_superelement(path).superelement;
  std::string all = text(e.name) + text(e.method) + text(e.producer) + text(e.units);
  for (const std::string& name : e.node_name) all += text(name);
  return all + bits(e.node_position) + bits(e.stiffness) + bits(e.mass);
}

void write_modal(const std::string& path) {
  const test_support::Rod rod{0.0, 1.0, 1e-3, 1e6, 4e5, 1e-7, 2000.0, 20};
  write_modal_body(path, test_support::modal_body(test_support::lumped_rod(rod), {}, 8));
}

std::string read_modal(const std::string& path) {
  const ModalBody b = read_modal_body(path).body;
  std::string all = text(b.name) + text(b.producer) + text(b.units);
  for (const std::string& name : b.node_name) all += text(name);
  all += bits(b.node_position) + bits(b.node_mass) + bits(b.omega2) + bits(b.zeta) + bits(b.frame_position) +
         bits(b.frame_orientation);
  for (const auto& X : b.X) all += bits(X);
  for (const auto& inertia : b.node_inertia) all += bits(inertia);
  const ModalIntegrals& i = b.integrals;
  return all + bits(i.c0) + bits(i.C1) + bits(i.P0) + bits(i.P1) + bits(i.P2) + bits(i.J_mu) + bits(i.N_mu) +
         bits(&i.mass, 1);
}

void write_point(const std::string& path) {
  Checkpoint c{"arm", "test", "fingerprint", 3, 0.25, "arm.results.h5", "run", 12, {}, {1, 2, 3}, "bodies.arm.mass: 2\n"};
  for (int k = 0; k < 2000; ++k) c.state.push_back(test_support::row_value(k, 1));
  write_checkpoint(path, c);
}

std::string read_point(const std::string& path) {
  const Checkpoint c = read_checkpoint(path);
  return text(c.scene) + text(c.producer) + text(c.fingerprint) + text(c.results) + text(c.run) +
         fmt::format("{} {} {} ", c.state_version, c.rows, c.time) + bits(c.state.data(), c.state.size()) +
         bits(c.schedule.data(), c.schedule.size()) + text(c.values);
}

test_support::SecondOrderBody network() {
  auto body = test_support::second_order_network(6, Eigen::Vector4d(0.1, 0.2, 0.3, 0.4));
  test_support::add_trapped_stress(body);
  return body;
}

void write_companion_file(const std::string& path) {
  test_support::SecondOrderBody body = network();
  write_companion(path, body.companion, body.element);
}

std::string read_companion_file(const std::string& path) {
  static const Superelement element = network().element;
  const Companion c = read_companion(path, element);
  std::string all = text(c.content_id) + text(c.companion_id) + text(c.producer) + text(c.units);
  all += bits(c.reference_point) + bits(c.weights) + bits(&c.mass, 1) + bits(c.S0) + bits(c.S1);
  for (const Eigen::MatrixXd& H : c.H) all += bits(H);
  for (const Eigen::MatrixXd& C : c.C) all += bits(C);
  for (const auto* arrays : {&c.E, &c.N, &c.T})
    for (const Eigen::MatrixXd& matrix : *arrays) all += bits(matrix);
  for (const Eigen::MatrixXd& Lambda : c.Lambda) all += bits(Lambda);
  for (const LoadCase& load : c.load_cases) all += text(load.name) + bits(load.force) + bits(load.stiffness);
  return all;
}

class Damage : public ::testing::TestWithParam<Kind> {
 protected:
  static int copies() { return test_support::trials(15); }
  /// How many of the damaged copies are errors; the others must read as the sound file does.
  int errors_after(const std::function<void(std::string& bytes, std::mt19937& random)>& spoil) const {
    const test_support::TemporaryFolder folder;
    const std::string path = folder.file("file.h5");
    GetParam().write(path);
    const std::string sound = GetParam().read(path);
    std::ifstream in(path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    int errors = 0;
    for (int seed = 1; seed <= copies(); ++seed) {
      std::mt19937 random(static_cast<unsigned>(seed));
      std::string spoilt = bytes;
      spoil(spoilt, random);
      std::ofstream(path, std::ios::binary) << spoilt;
      try {
        EXPECT_TRUE(GetParam().read(path) == sound) << "other contents without an error, seed " << seed;
      } catch (const Error& error) {
        ++errors;
        EXPECT_NE(std::string(error.what()).find("file.h5"), std::string::npos) << error.what();
      }
    }
    return errors;
  }
};
INSTANTIATE_TEST_SUITE_P(Files, Damage,
                         ::testing::Values(Kind{"results", write_results, read_results},
                                           Kind{"superelement", write_element, read_element},
                                           Kind{"companion", write_companion_file, read_companion_file},
                                           Kind{"modal_body", write_modal, read_modal},
                                           Kind{"checkpoint", write_point, read_point}),
                         [](const ::testing::TestParamInfo<Kind>& given) { return given.param.name; });

// What stands in no dataset (the rest of a chunk that is not full, free space) may change without harm.
TEST_P(Damage, ChangedBytesGiveTheSameNumbersOrAnError) {
  EXPECT_GT(errors_after([](std::string& bytes, std::mt19937& random) {
              for (unsigned flips = 1 + random() % 8; flips > 0; --flips)
                bytes[random() % bytes.size()] ^= static_cast<char>(1 + random() % 255);
            }),
            copies() / 5);
}

TEST_P(Damage, LostSectorsGiveTheSameNumbersOrAnError) {
  EXPECT_GT(errors_after([](std::string& bytes, std::mt19937& random) {
              const std::size_t first = random() % bytes.size() / 512 * 512;
              bytes.replace(first, std::min<std::size_t>(512, bytes.size() - first),
                            std::min<std::size_t>(512, bytes.size() - first), '\0');
            }),
            copies() / 15);
}

}  // namespace
}  // namespace tisserand::formats::damage_test
