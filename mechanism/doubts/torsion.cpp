// SPDX-License-Identifier: GPL-3.0-or-later
// Validity check of the torsional stiffness of straight superelements that spin, for their inertia option.
#include <cmath>
#include <map>
#include <numeric>

#include <fmt/format.h>
#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include "common/math/rotation.hpp"
#include "mechanism/doubts/doubt.hpp"
#include "mechanism/doubts/held_body.hpp"
#include "mechanism/doubts/straight_beam.hpp"
#include "mechanism/equations/terms.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using formats::InertiaOption;

/// A tenth of a stiffness, as for axial forces (EN 1993-1-1, 5.2.1 (3)). Two halves of a 10 m blade at 6 rad/s turn
/// over from round-off within 40 s at 2.8 and 1.2 of their stiffness. At 0.84 and 0.28 they stay in their plane.
constexpr double most_moment = 0.1;
/// Growth of the spin after which moments are measured again. In between they grow with the square of the spin.
constexpr double growth = 1.5;
/// Largest number of instants of a run.
constexpr double most_measured = 200.0;
/// Increment of the central differences [rad].
constexpr double turn = 1e-3;

bool is_judged(const SuperelementBody& body) {
  return !body.planar && !body.second_order.any() &&
         (body.inertia == InertiaOption::B || body.inertia == InertiaOption::M) &&
         body.frame != FrameAlgorithm::incremental;
}

/// The node rotated by `angle` about one of its own axes, with constant angular velocity in space.
NodeMotion turned(NodeMotion node, const Vector3d& axis, double angle) {
  const Eigen::Matrix3d E = exp_so3<double>(angle * axis);
  node.R *= E;
  node.Omega = E.transpose() * node.Omega;
  node.Omegad = E.transpose() * node.Omegad;
  return node;
}

/// Validity check of torsion. With B and M the momentum p of a node's rotation contains that of the bending shapes, up
/// to m L v/12 in a piece that moves with v. The moments Ω x p turn with the node: a twist θ feels ~ m L v Ω θ/12 about
/// its axis, positive at one end of a piece and negative at the other. A real beam does not feel it, nor does A. The
/// check measures ∂(r − r_A)/∂θ of the nodes as spins grow, scaled to the fastest. It takes the largest eigenvalue of
/// these moments of all pieces welded in a row relative to their torsional stiffness. Above one they turn over.
class Torsion : public Doubt {
 public:
  Torsion(const formats::Scene& scene, const Model& model)
      : seen_(model.superelements.size()),
        pause_((scene.integrator.end - scene.integrator.start) / most_measured),
        next_(scene.integrator.start) {
    for (const SuperelementBody& body : model.superelement_bodies) {
      Judged& judged = judged_.emplace_back();
      if (!is_judged(body) || !(judged.axis = axis_of(body))) continue;
      for (const InertiaOption option : {body.inertia, InertiaOption::A}) {
        judged.options.push_back({body, make_scratch(body)});
        judged.options.back().body.inertia = option;
      }
      active_ = true;
    }
    if (active_) beams_ = welded_beams(model);
  }

  void observe(const Instant& at) override {
    const auto& [model, state, evaluation] = at;
    if (!active_ || state.time() < next_) return;
    next_ = state.time() + pause_;
    if (twist_.place.empty()) twist_ = twist_of(model, evaluation);
    for (std::size_t i = 0; i < seen_.size(); ++i) {
      if (judged_[model.superelements[i].body].options.empty()) continue;
      const double spin = evaluation.superelements[i].motion.Omega0.norm();
      if (!(spin > seen_[i].spin)) continue;
      seen_[i].spin = spin;
      seen_[i].time = state.time();
      if (!(spin > growth * seen_[i].measured)) continue;
      measure(model, state, evaluation, i);
      seen_[i].measured = spin;
    }
  }

  /// At most one warning: the softest beam.
  std::vector<std::string> doubts(const Model& model, const StressedBodies&) const override {
    double worst = most_moment;
    int at = -1;
    for (int i = 0; i < std::ssize(seen_); ++i) {
      if (beams_.empty() || beams_[i] != i) continue;
      if (const double now = ratio(model, beams_[i]); now > worst) worst = now, at = i;
    }
    if (at < 0) return {};
    return {fmt::format(
        "'{}' is too soft in torsion for its spin ({:.3g} {} at t = {:.6g}{}). Inertia {} causes "
        "moments on its nodes that a real beam does not have. They are {:.2g} of its torsional stiffness (limit {:g}; "
        "above 1 the body turns over). Use 'inertia: A', or `second_order: on` with its companion file",
        model.superelements[at].name, seen_[at].spin, turn_rate_label(model.units), seen_[at].time,
        after_time(model.units), letter(body_of(model, at).inertia), worst, most_moment)};
  }

  std::string explanation(Puzzle puzzle, const Model& model) const override {
    const std::vector<std::string> soft = puzzle == Puzzle::failure ? doubts(model, {}) : std::vector<std::string>{};
    return soft.empty() ? "" : soft.front();
  }

 private:
  struct Option {
    SuperelementBody body;
    SuperelementScratch scratch;
  };
  /// Constants of a body; without options: not checked.
  struct Judged {
    std::optional<Axis> axis;
    std::vector<Option> options;  ///< its own, then A
  };
  struct Seen {
    double spin = 0.0, time = 0.0;  ///< fastest spin and its time
    double measured = 0.0;          ///< spin at which the moments were measured
    Eigen::MatrixXd moment;         ///< ∂(r − r_A)/∂θ, in the order of the body's rotation nodes
  };
  void measure(const Model& model, const State& state, const Evaluation& evaluation, std::size_t use) {
    Judged& judged = judged_[model.superelements[use].body];
    const SuperelementBody& body = body_of(model, use);
    const int internal = model.internal_offset[use], first = model.sizes.boundary + internal;
    const Eigen::Matrix3d& R0 = evaluation.superelements[use].motion.R0;
    const auto n = static_cast<Eigen::Index>(body.rotation_nodes.size());
    std::vector<NodeMotion> nodes;
    std::vector<Vector3d> axes;
    for (const int node : model.superelements[use].nodes) {
      nodes.push_back(evaluation.motion[node]);
      axes.push_back(nodes.back().R.transpose() * R0 * judged.axis->direction);
    }
    std::vector<int> order(nodes.size());
    std::iota(order.begin(), order.end(), 0);
    MatrixXd& moment = seen_[use].moment;
    moment.setZero(n, n);
    for (Eigen::Index b = 0; b < n; ++b)
      for (const double side : {1.0, -1.0}) {
        const int at = body.rotation_nodes[b];
        const NodeMotion kept = nodes[at];
        nodes[at] = turned(kept, axes[at], side * turn);
        double sign = side / (2.0 * turn);
        for (Option& option : judged.options) {
          update_kinematics(option.body, NodeView<NodeMotion>{nodes.data(), order.data()}, state.y().data() + internal,
                            state.v().data() + first, state.vdot().data() + first, R0, option.scratch);
          residual(option.body, option.scratch, Vector3d::Zero());
          for (Eigen::Index a = 0; a < n; ++a) {
            const SuperelementNode& node = body.node[body.rotation_nodes[a]];
            moment(a, b) +=
                sign * axes[body.rotation_nodes[a]].dot(option.scratch.forces.r_B.segment<3>(node.rotation_row));
          }
          sign = -sign;
        }
        nodes[at] = kept;
      }
  }

  double ratio(const Model& model, int beam) const {
    std::map<int, int> row;  // rows of places that can turn
    const auto row_of = [&](std::size_t use, int node) {
      const int place = twist_.place[model.superelements[use].nodes[node]];
      return twist_.held[place] ? -1 : row.try_emplace(place, count_of(row)).first->second;
    };
    const auto pieces = [&](auto visit) {
      for (std::size_t i = 0; i < seen_.size(); ++i)
        if (beams_[i] == beam && seen_[i].moment.size() > 0) visit(i, body_of(model, i));
    };
    pieces([&](std::size_t i, const SuperelementBody& body) {
      for (const int node : body.rotation_nodes) (void)row_of(i, node);
    });
    const auto n = static_cast<Eigen::Index>(row.size());
    MatrixXd stiffness = MatrixXd::Zero(n, n), moment = stiffness;
    pieces([&](std::size_t i, const SuperelementBody& body) {
      const Axis& axis = *judged_[model.superelements[i].body].axis;
      const double grown = std::pow(seen_[i].spin / seen_[i].measured, 2);
      for (std::size_t a = 0; a < body.rotation_nodes.size(); ++a)
        for (std::size_t b = 0; b < body.rotation_nodes.size(); ++b) {
          const int p = row_of(i, body.rotation_nodes[a]), q = row_of(i, body.rotation_nodes[b]);
          if (p < 0 || q < 0) continue;
          stiffness(p, q) +=
              along(body.S_BB, body.node[body.rotation_nodes[a]], body.node[body.rotation_nodes[b]], axis);
          moment(p, q) += 0.5 * grown * (seen_[i].moment(a, b) + seen_[i].moment(b, a));
        }
    });
    // The whole beam can turn freely: the check of axial spin covers this.
    if (n == 0 || Eigen::SelfAdjointEigenSolver<MatrixXd>(stiffness, Eigen::EigenvaluesOnly).eigenvalues()[0] <
                      1e-9 * stiffness.trace())
      return 0.0;
    return Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd>(moment, stiffness, Eigen::EigenvaluesOnly)
        .eigenvalues()
        .cwiseAbs()
        .maxCoeff();
  }

  std::vector<Judged> judged_;  ///< constants of each body
  std::vector<Seen> seen_;      ///< values of each use
  std::vector<int> beams_;
  Twist twist_;
  bool active_ = false;
  double pause_ = 0.0, next_ = 0.0;
};

}  // namespace

std::unique_ptr<Doubt> torsion(const formats::Scene& scene, const Model& model) {
  return std::make_unique<Torsion>(scene, model);
}

}  // namespace tisserand::mechanism
