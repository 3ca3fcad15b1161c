// SPDX-License-Identifier: GPL-3.0-or-later
// Lumped masses, their modes under reference conditions, and the sums over the nodes.
#include "reducer/modal_body/modal_body.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>
#include <Eigen/Cholesky>
#include <Eigen/SVD>

#include "common/error.hpp"
#include "common/math/rotation.hpp"
#include "common/parallel.hpp"
#include "common/program/version.hpp"
#include "common/text.hpp"
#include "reducer/elements/element_matrices.hpp"
#include "reducer/modal_body/static_answers.hpp"
#include "reducer/modes/full_model.hpp"
#include "reducer/modes/internal_modes.hpp"
#include "reducer/system/assembly.hpp"
#include "reducer/system/mechanism.hpp"

namespace tisserand::reducer {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Mesh with lumped mass matrices for all elements, and with the held nodes as its boundary.
Mesh lumped_mesh(Mesh mesh) {
  for (BeamProperty& property : mesh.beam_properties) property.data.mass_matrix = formats::MassMatrix::lumped;
  for (ShellProperty& property : mesh.shell_properties) property.mass_matrix = formats::MassMatrix::lumped;
  for (SolidProperty& property : mesh.solid_properties) property.mass_matrix = formats::MassMatrix::lumped;
  mesh.boundary.clear();
  for (const FrameNode& held : mesh.held)
    mesh.boundary.push_back(
        {held.name, held.node, (held.components & translations_only) != 0, (held.components & rotations_only) != 0});
  return mesh;
}

/// Sum of the lumped element matrices and nodal masses, node by node. Throws Error if they couple nodes.
std::vector<Matrix6> nodal_blocks(const Mesh& mesh, const Coordinates& coordinates, const std::string& where) {
  const SymmetricPair pair = assemble(mesh, coordinates, core_count());
  std::vector<Matrix6> blocks(static_cast<std::size_t>(mesh.nodes()), Matrix6::Zero());
  for (int i = 0; i < pair.size(); ++i)
    for (int k = pair.begin[i]; k < pair.begin[i + 1]; ++k) {
      const int j = pair.column[k], a = coordinates.node[i], b = coordinates.node[j];
      if (a == b)
        blocks[a](coordinates.component[i], coordinates.component[j]) =
            blocks[a](coordinates.component[j], coordinates.component[i]) = pair.M[k];
      else if (std::abs(pair.M[k]) > 1e-12 * std::sqrt(pair.M[pair.begin[i]] * pair.M[pair.begin[j]]))
        throw Error(fmt::format("modal_body: lumped masses couple {} and {}", mesh.node_label[a], mesh.node_label[b]),
                    where, "a beam there has releases: use a joint or a spring in their place");
    }
  return blocks;
}

/// Mass of a node as a rigid body with its centre of mass at `offset` from the node. Throws Error if it is none.
NodalMass rigid_mass(const Matrix6& block, int node, const Mesh& mesh, double length, const std::string& where) {
  NodalMass mass;
  mass.node = node;
  mass.mass = block(0, 0);
  mass.inertia = block.bottomRightCorner<3, 3>();
  if (!(mass.mass > 0.0)) return mass;
  mass.offset = Eigen::Vector3d(block(1, 5), block(2, 3), block(0, 4)) / mass.mass;
  const Matrix6 moved = nodal_mass_matrix({node, mass.mass, Eigen::Matrix3d::Zero(), mass.offset, ""});
  if ((block - moved).leftCols<3>().cwiseAbs().maxCoeff() > 1e-9 * mass.mass * std::max(1.0, length))
    throw Error(fmt::format("modal_body: the lumped mass at {} is not that of a rigid body", mesh.node_label[node]),
                where, "the sections of its beams have a mass off the axis, but not its inertia: change their offsets");
  mass.inertia -= moved.bottomRightCorner<3, 3>();
  if (mass.inertia.cwiseAbs().maxCoeff() < 1e-12 * block.bottomRightCorner<3, 3>().cwiseAbs().maxCoeff())
    mass.inertia.setZero();
  return mass;
}

/// Modes in the system's coordinates q.
struct LumpedModes {
  Eigen::VectorXd lambda;
  Eigen::MatrixXd q;
  std::string solver;  ///< report of the solver
};

Partition held_partition(const Mesh& mesh, const System& system) {
  std::vector<OwnedCoordinate> held;
  for (int k = 0; k < std::ssize(mesh.held); ++k)
    for (int component = 0; component < 6; ++component)
      if ((mesh.held[k].components >> component & 1) != 0)
        held.push_back({system.coordinates.of(mesh.held[k].node, component), k});
  return partition(system, held);
}

[[noreturn]] void fail_for_modes(int asked, int available, const std::string& where) {
  throw Error(fmt::format("modal_body: {} modes asked for, but only {} exist", asked, available), where,
              "ask for fewer modes, or use more elements or masses with rotary inertia");
}

LumpedModes held_modes(const Mesh& mesh, const System& system, const formats::ModalBodyRequest& body,
                       const formats::ModeSelection& asked) {
  const Partition p = held_partition(mesh, system);
  const Eigen::JacobiSVD<Eigen::MatrixXd> held(rows(system.R, p.boundary));
  if (const auto& value = held.singularValues(); !(value[5] > 1e-8 * value[0]))
    throw Error("modal_body: the six held components leave a rigid motion of the part free", body.where,
                "hold all components of one node, or 3, 2 and 1 translations at three nodes, or for a rod four "
                "components at one node and two at another");
  const Blocks blocks = split(system.matrices, p);
  const Factor S_II(blocks.S_II);
  require_stiffness(null_space(blocks.S_II, S_II), S_II, {mesh, system, p},
                    {"the modal body", "on its reference",
                     "give the elements there stiffness in that direction, or split the part at the hinge: a modal "
                     "body cannot contain a mechanism"},
                    body.where);
  const int available = finite_mode_count(blocks.M_II);
  if (body.modes > available) fail_for_modes(body.modes, available, body.where);
  const Spectrum spectrum = lowest_pairs({blocks.S_II, blocks.M_II, S_II, 0.0}, body.modes, available,
                                         choose_solver(p.n_I(), body.modes, asked), Count::if_cheap);
  LumpedModes modes{spectrum.pairs.value.head(spectrum.kept), {}, report_of(spectrum).text};
  Eigen::MatrixXd Phi = spectrum.pairs.vector.leftCols(spectrum.kept);
  fix_basis({{mesh, system, p}, blocks, S_II, body.where}, modes.lambda, Phi);
  modes.q.setZero(system.size(), spectrum.kept);
  modes.q(p.internal, Eigen::all) = Phi;
  return modes;
}

/// Removes the round-off along rigid motions and restores Xᵀ M X = 1.
void make_orthogonal_to_rigid_motions(const System& system, Eigen::MatrixXd& q) {
  const Eigen::MatrixXd rigid = system.R.transpose() * system.MR;
  q -= system.R * rigid.ldlt().solve(system.MR.transpose() * q);
  const Eigen::MatrixXd gram = q.transpose() * multiply(symmetric_rows(system.matrices, system.matrices.M), q);
  q = gram.llt().matrixU().solve<Eigen::OnTheRight>(q).eval();
}

LumpedModes free_modes(const Mesh& mesh, const System& system, const formats::ModalBodyRequest& body,
                       const formats::ModeSelection& asked, double lowest) {
  if (!(lowest > 0.0))
    throw Error("modal_body: the part has no free frequencies, so it has no mean axis", body.where,
                "hold six components, for example reference: tip");
  const std::optional<FreeModes> pairs = full_free_modes(system, {.scale = lowest, .count = body.modes}, asked);
  if (!pairs)
    throw Error(
        "modal_body: the mass or inertia of the lumped masses is zero in a rigid motion, so the mean axis is not "
        "defined",
        body.where, "hold six components, or give the part inertia about every axis");
  if (pairs->value.size() < body.modes) fail_for_modes(body.modes, count_of(pairs->value), body.where);
  LumpedModes modes{pairs->value, pairs->vector, pairs->solver.text};
  const Partition p = held_partition(mesh, system);
  const Factor none;
  fix_basis({{mesh, system, p}, Blocks{}, none, body.where}, modes.lambda, modes.q);
  make_orthogonal_to_rigid_motions(system, modes.q);
  return modes;
}

/// Row of the file: a node of the mesh, or the centre of mass of a mass with an offset from one.
struct LumpedNode {
  std::string name;
  NodalMass mass;
  Eigen::Vector3d arm = Eigen::Vector3d::Zero();  ///< from the node of the mesh
  bool kept = false;
};

/// Nodes of the file: boundary and held nodes by name, others by number, masses with an offset in rows of their own.
std::vector<LumpedNode> lumped_nodes(const Mesh& mesh, const Mesh& lumped, const System& system,
                                     const formats::ModalBodyRequest& body) {
  std::vector<std::string> name(static_cast<std::size_t>(mesh.nodes()));
  for (const FrameNode& held : mesh.held) name[held.node] = held.name;
  for (const MeshBoundary& boundary : mesh.boundary) name[boundary.node] = boundary.name;
  const std::vector<Matrix6> blocks = nodal_blocks(lumped, system.coordinates, body.where);
  std::vector<LumpedNode> nodes;
  for (int n = 0; n < mesh.nodes(); ++n) {
    const bool kept = body.all_nodes || !name[n].empty();
    if (name[n].empty()) name[n] = fmt::format("n{}", n + 1);
    const NodalMass mass = rigid_mass(blocks[n], n, mesh, system.length, body.where);
    NodalMass without_mass;
    without_mass.node = n;
    const bool beside = mass.offset.norm() > 1e-12 * system.length;
    nodes.push_back({name[n], beside ? without_mass : mass, Eigen::Vector3d::Zero(), kept});
    if (beside) nodes.push_back({name[n] + "_mass", mass, mass.offset, body.all_nodes});
  }
  return nodes;
}

/// Fills in the nodes of the file, with their positions in the part.
void fill(const Mesh& mesh, const System& system, const LumpedModes& modes, const std::vector<LumpedNode>& nodes,
          formats::ModalBody& body) {
  const Eigen::MatrixXd x = expand(system.T, modes.q);
  const auto n = static_cast<Eigen::Index>(nodes.size());
  body.node_name.clear();
  body.node_inertia.clear();
  body.X.clear();
  body.node_position.resize(n, 3);
  body.node_mass.resize(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const LumpedNode& node = nodes[k];
    const int at = node.mass.node;
    body.node_name.push_back(node.name);
    body.node_position.row(k) = (mesh.position.col(at) + node.arm - body.frame_position).transpose();
    body.node_mass[k] = node.mass.mass;
    body.node_inertia.push_back(node.mass.inertia);
    Eigen::Matrix<double, 6, Eigen::Dynamic> X(6, modes.q.cols());
    X.setZero();
    const int components = system.coordinates.rotates(at) ? 6 : 3;
    X.topRows(components) = x.middleRows(system.coordinates.first[at], components);
    X.topRows<3>() -= skew<double>(node.arm) * X.bottomRows<3>();
    body.X.push_back(std::move(X));
  }
}

Eigen::Vector3d center_of_mass(const Mesh& mesh, const std::vector<LumpedNode>& nodes) {
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  double mass = 0.0;
  for (const LumpedNode& node : nodes) {
    moment += node.mass.mass * (mesh.position.col(node.mass.node) + node.arm);
    mass += node.mass.mass;
  }
  return moment / mass;
}

void set_reference(const Mesh& mesh, formats::ModalBody& body) {
  if (mesh.held.empty()) body.reference = formats::ModalReference::mean_axis;
  for (const FrameNode& held : mesh.held)
    for (int component = 0; component < 6; ++component) {
      if ((held.components >> component & 1) == 0) continue;
      const auto row = std::ranges::find_if(body.node_name, [&](const std::string& name) {
        return name == held.name || std::ranges::any_of(mesh.boundary, [&](const MeshBoundary& boundary) {
                 return boundary.node == held.node && boundary.name == name;
               });
      });
      body.reference_node.push_back(static_cast<int>(row - body.node_name.begin()));
      body.reference_component.push_back(component);
    }
}

/// Data for the certificate.
ModalBodyCertificate describe(const formats::ModalBody& body, const std::string& solver) {
  ModalBodyCertificate c;
  c.eigenvalue_solver = solver;
  for (const double value : body.omega2) c.frequency.push_back(frequency(value));
  const formats::ModalIntegrals& sums = body.integrals;
  c.rigid = {sums.mass, body.frame_position, sums.P0.trace() * Eigen::Matrix3d::Identity() - sums.P0 + sums.J_mu};
  std::vector<std::string> held;
  for (const int row : body.reference_node)
    if (held.empty() || held.back() != body.node_name[row]) held.push_back(body.node_name[row]);
  c.reference = held.empty() ? "mean axis" : join(held, ", ") + " held";
  return c;
}

/// Static answers that the modes omit, for all nodes that the part names.
LumpedAnswers answers_of(const Mesh& mesh, const System& system, const LumpedModes& modes,
                         const std::vector<LumpedNode>& nodes, const formats::ModalBody& body) {
  AnsweredBody asked{
      system, held_partition(mesh, system).boundary, modes.lambda, modes.q, {}, {}, mesh.position, body.frame_position};
  for (const LumpedNode& node : nodes) asked.masses.push_back({node.mass, node.arm});
  for (const MeshBoundary& boundary : mesh.boundary) asked.nodes.push_back({boundary.name, boundary.node});
  for (const FrameNode& held : mesh.held)
    if (std::ranges::find(asked.nodes, held.node, &NamedNode::node) == asked.nodes.end())
      asked.nodes.push_back({held.name, held.node});
  return lumped_answers(asked);
}

/// Sets the residual flexibility, except for many named nodes, whose matrices would make the file large.
void set_residual(const LumpedAnswers& answers, formats::ModalBody& body) {
  constexpr std::size_t most = 600;
  if (answers.forces.size() > most) return;
  for (const formats::AppliedLoad& force : answers.forces) {
    const auto row = std::ranges::find(body.node_name, force.node);
    body.residual.node.push_back(static_cast<int>(row - body.node_name.begin()));
    body.residual.component.push_back(force.component);
  }
  body.residual.flexibility = answers.flexibility;
  body.residual.mass = answers.mass;
  body.residual.coupling = answers.coupling;
}

struct FoundBody {
  formats::ModalBody body;
  std::string solver;
};

FoundBody find_body(const Mesh& mesh, const formats::Part& part, double lowest, const RecoveryListener& recover) {
  const formats::ModalBodyRequest& request = *part.modal_body;
  const Mesh lumped = lumped_mesh(mesh);
  const System system = build_system(lumped, part.file);
  const LumpedModes modes = mesh.held.empty() ? free_modes(lumped, system, request, part.modes, lowest)
                                              : held_modes(lumped, system, request, part.modes);
  std::vector<LumpedNode> nodes = lumped_nodes(mesh, lumped, system, request);
  formats::ModalBody body;
  body.name = part.name;
  body.producer = producer("reducer");
  body.units = part.units;
  body.all_nodes = request.all_nodes;
  body.frame_position = center_of_mass(mesh, nodes);
  body.omega2 = modes.lambda;
  body.zeta.setConstant(modes.lambda.size(), request.damping);
  fill(mesh, system, modes, nodes, body);
  body.integrals = formats::integrals_of(body);
  const std::vector<LumpedNode> all = nodes;
  if (!request.all_nodes) {
    std::erase_if(nodes, [](const LumpedNode& node) { return !node.kept; });
    fill(mesh, system, modes, nodes, body);
  }
  set_reference(mesh, body);
  LumpedAnswers answers = answers_of(mesh, system, modes, all, body);
  set_residual(answers, body);
  if (recover) {
    RecoverySource source = recovery_source(mesh, system, modes.q, body, std::move(answers.x));
    source.head.loads = {body.frame_position, std::move(answers.forces), std::move(answers.share),
                         body.omega2,         body.omega2.maxCoeff(),    {}};
    recover(source);
  }
  return {std::move(body), modes.solver};
}

}  // namespace

formats::ModalBody lumped_modal_body(const Mesh& mesh, const formats::Part& part, double lowest,
                                     const RecoveryListener& recover) {
  return find_body(mesh, part, lowest, recover).body;
}

formats::ModalBody modal_body(const Mesh& mesh, const formats::Part& part, const FileCertificate& file,
                              const RecoveryListener& recover, ModelCertificate& model) {
  const double lowest =
      file.free_frequency.empty() ? 0.0 : std::pow(2.0 * std::numbers::pi * file.free_frequency[0], 2);
  FoundBody found = find_body(mesh, part, lowest, part.recovery ? recover : nullptr);
  model.modal_body = describe(found.body, found.solver);
  return std::move(found.body);
}

}  // namespace tisserand::reducer
