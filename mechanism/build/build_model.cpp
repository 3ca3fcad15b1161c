// Bodies become nodes and elements, places become markers, joints and loads refer to markers.
#include "mechanism/build/build_model.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <Eigen/LU>

#include "common/error.hpp"
#include "common/text.hpp"
#include "mechanism/bodies/beam/mesh.hpp"
#include "mechanism/build/joints.hpp"
#include "mechanism/build/mirrored_files.hpp"
#include "mechanism/build/modal_bodies.hpp"
#include "mechanism/build/superelements.hpp"
#include "mechanism/build/virtual_bodies.hpp"
#include "mechanism/equations/evaluate.hpp"
#include "mechanism/equations/increments.hpp"
#include "mechanism/equations/iteration_matrix.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

class Builder {
 public:
  Builder(const formats::Scene& scene, const BodyFiles& files)
      : scene_(scene), superelements_(files.superelements), modal_bodies_(files.modal_bodies) {}

  BuiltModel build() {
    model_.name = scene_.name;
    model_.units = scene_.units;
    model_.gravity = scene_.gravity;
    model_.internal_offset = {0};
    for (const formats::BodySpec& body : scene_.bodies) {
      collect([&] { std::visit([this](const auto& spec) { add_body(spec); }, body); });
    }
    collect([this] { add_virtual_bodies(); });
    throw_errors();
    initial_motion();
    collect([this] { eliminate_virtual_bodies(); });
    throw_errors();
    JointBuilder joints(markers_, model_, breakpoints_);
    for (const formats::JointSpec& joint : scene_.joints)
      if (!vanished_.contains(joint.name)) collect([&] { joints.add(joint); });
    throw_errors();
    for (const formats::GearSpec& gear : scene_.gears) collect([&] { joints.add(gear); });
    for (const formats::InputSpec& input : scene_.inputs) joints.add(input);
    for (const formats::ChannelSpec& channel : scene_.channels) collect([&] { joints.add(channel); });
    throw_errors();
    for (const formats::MotionSpec& motion : scene_.motions) collect([&] { joints.add(motion); });
    for (const formats::SpringSpec& spring : scene_.springs) collect([&] { joints.add(spring); });
    for (const formats::BushingSpec& bushing : scene_.bushings) collect([&] { joints.add(bushing); });
    for (const formats::LoadSpec& load : scene_.loads) collect([&] { add_load(load); });
    throw_errors();
    finish();
    BuiltModel built{std::move(model_), State(Sizes{}), std::move(notes_)};
    built.state = initial_state(built.model);
    return built;
  }

 private:
  // ---- errors -------------------------------------------------------------------------------------------------------
  template <class Action>
  void collect(Action action) {
    try {
      action();
    } catch (const Error& error) {
      errors_.push_back(error);
    }
  }
  void throw_errors() const {
    if (!errors_.empty()) throw merge_errors(errors_);
  }

  // ---- bodies -------------------------------------------------------------------------------------------------------
  /// A node at `position` (part frame) of a body that starts with `start`.
  int add_node(const std::string& name, const formats::InitialMotion& start, const Vector3d& position, int translations,
               int rotations) {
    Node node{name, -1, -1, -1};
    if (translations) node.translation = std::exchange(model_.sizes.boundary, model_.sizes.boundary + 3);
    if (rotations) node.rotation = std::exchange(model_.sizes.boundary, model_.sizes.boundary + 3);
    model_.nodes.push_back(node);
    markers_.start.push_back(motion_at(start, position));
    return static_cast<int>(model_.nodes.size()) - 1;
  }

  static NodeMotion motion_at(const formats::InitialMotion& start, const Vector3d& position) {
    NodeMotion motion;
    motion.R = start.pose.orientation.normalized().toRotationMatrix();
    const Vector3d arm = motion.R * position;
    motion.x = start.pose.position + arm;
    motion.xd = start.velocity + start.angular_velocity.cross(arm);
    motion.Omega = motion.R.transpose() * start.angular_velocity;
    return motion;
  }

  void add_place(const std::string& name, const Marker& marker) {
    model_.places.push_back({name, marker});
    markers_.places[name] = marker;
  }

  void note_units(const std::string& name, const Units& from, const UnitConversion& units) {
    if (from.named() && (units.length != 1.0 || units.mass != 1.0 || units.time != 1.0))
      notes_.push_back(fmt::format("body '{}': converted from {}, {}, {} to {}, {}, {}", name, from.length.label,
                                   from.mass.label, from.time.label, scene_.units.length.label, scene_.units.mass.label,
                                   scene_.units.time.label));
  }

  void add_body(const formats::ModalBodySpec& spec) {
    const formats::LoadedModalBody& file = modal_bodies_.at(spec.file, spec.mirror);
    const UnitConversion units = convert_units(file.body.units, scene_.units, spec.file);
    note_units(spec.name, file.body.units, units);
    for (const std::string& warning : file.warnings) notes_.push_back(fmt::format("body '{}': {}", spec.name, warning));
    BuiltModalBody built = build_modal_body(file.body, spec, units);
    if (built.body.modes < static_cast<int>(file.body.modes()))
      notes_.push_back(
          fmt::format("body '{}': {} of {} modes are used", spec.name, built.body.modes, file.body.modes()));
    formats::InitialMotion start = spec.start;
    const Matrix3d turn = start.pose.orientation.normalized().toRotationMatrix();
    const Vector3d arm = turn * built.frame_position;
    start.pose.position += arm;
    start.velocity += start.angular_velocity.cross(arm);
    start.pose.orientation = Eigen::Quaterniond(turn * built.frame_rotation);
    built.body.node = add_node(spec.name, start, Vector3d::Zero(), 1, 1);
    built.body.gravity = spec.gravity.value_or(scene_.gravity);
    built.body.offset = std::exchange(model_.sizes.modal, model_.sizes.modal + built.body.modes);
    const Matrix3d part_axes = built.frame_rotation.transpose();
    add_place(spec.name, {built.body.node, Vector3d::Zero(), part_axes});
    for (ModalNode& node : built.nodes) {
      const std::string name = spec.name + "/" + node.name;
      node.body = static_cast<int>(model_.modal_bodies.size());
      node.node = add_node(name, start, node.x, 0, 0);
      model_.nodes.back().modal = static_cast<int>(model_.modal_nodes.size());
      model_.modal_nodes.push_back(std::move(node));
      add_place(name, {model_.modal_nodes.back().node, Vector3d::Zero(), part_axes});
    }
    model_.modal_bodies.push_back(std::move(built.body));
  }

  void add_body(const formats::SuperelementBodySpec& spec) {
    const formats::LoadedSuperelement& file = superelements_.at(spec.file, spec.mirror);
    const formats::Superelement& element = file.superelement;
    const UnitConversion units = convert_units(element.units, scene_.units, spec.file);
    note_units(spec.name, element.units, units);
    for (const std::string& warning : file.report.warnings)
      notes_.push_back(fmt::format("body '{}': {}", spec.name, warning));
    if (spec.rigid) {
      add_rigid_superelement(spec, file, units);
      return;
    }
    SuperelementUse use;
    use.name = spec.name;
    use.body = find_or_build(spec, file, units, built_superelements_, model_.superelement_bodies);
    use.gravity = spec.gravity.value_or(scene_.gravity);
    const SuperelementBody& body = model_.superelement_bodies[use.body];
    for (const std::string& note : body.notes) notes_.push_back(fmt::format("body '{}': {}", spec.name, note));
    for (const SuperelementNode& node : body.node) {
      const std::string name = spec.name + "/" + node.name;
      const Vector3d position = body.reference_origin + node.X;
      use.nodes.push_back(add_node(name, spec.start, position, node.has_translation(), node.has_rotation()));
      add_place(name, {use.nodes.back(), Vector3d::Zero(), Matrix3d::Identity()});
    }
    model_.internal_offset.push_back(model_.internal_offset.back() + body.modes);
    model_.superelement_content_ids.push_back(element.content_id);
    model_.superelements.push_back(std::move(use));
    frames_.push_back(spec.start.pose.orientation.normalized());
  }

  void add_rigid_superelement(const formats::SuperelementBodySpec& spec, const formats::LoadedSuperelement& file,
                              const UnitConversion& units) {
    formats::RigidBodySpec rigid;
    rigid.name = spec.name;
    rigid.gravity = spec.gravity;
    rigid.start = spec.start;
    rigid.mass = file.report.rigid.mass * units.mass;
    rigid.center_of_mass = file.report.rigid.center_of_mass * units.length;
    rigid.inertia = file.report.rigid.inertia * (units.mass * units.length * units.length);
    rigid.where = spec.where;
    const formats::Superelement& element = file.superelement;
    for (std::size_t j = 0; j < element.node_name.size(); ++j) {
      formats::RigidNodeSpec node;
      node.name = element.node_name[j];
      node.pose.position = element.node_position.row(j).transpose() * units.length;
      rigid.nodes.push_back(node);
    }
    add_body(rigid);
  }

  void add_body(const formats::RigidBodySpec& spec) {
    const int node = add_node(spec.name, spec.start, spec.center_of_mass, 1, 1);
    model_.rigid_bodies.push_back({spec.name, node, spec.mass, spec.inertia, spec.gravity.value_or(scene_.gravity)});
    add_place(spec.name, {node, -spec.center_of_mass, Matrix3d::Identity()});
    for (const formats::RigidNodeSpec& place : spec.nodes)
      add_place(spec.name + "/" + place.name, {node, place.pose.position - spec.center_of_mass,
                                               place.pose.orientation.normalized().toRotationMatrix()});
  }

  void add_body(const formats::BeamBodySpec& spec) {
    const BeamMesh mesh = mesh_beam(spec, 0);
    std::vector<int> nodes;
    for (std::size_t i = 0; i < mesh.position.size(); ++i) {
      const std::string name = fmt::format("{}/{}", spec.name, i);
      nodes.push_back(add_node(name, spec.start, mesh.position[i], 1, 1));
      add_place(name, {nodes.back(), Vector3d::Zero(), Matrix3d::Identity()});
    }
    markers_.places[spec.name + "/start"] = {nodes.front(), Vector3d::Zero(), Matrix3d::Identity()};
    markers_.places[spec.name + "/end"] = {nodes.back(), Vector3d::Zero(), Matrix3d::Identity()};
    const Vector3d gravity = spec.gravity.value_or(scene_.gravity);
    const auto append = [&nodes, &gravity](const auto& elements, auto& pool) {
      for (auto element : elements) {
        element.gravity = gravity;
        for (int& node : element.nodes) node = nodes[node];
        pool.push_back(element);
      }
    };
    append(mesh.elements2, model_.beams2);
    append(mesh.elements3, model_.beams3);
  }

  void add_body(const formats::VirtualBodySpec&) {}  // after all others: add_virtual_bodies()

  /// Kept ones are nodes. Those to be eliminated stand behind all nodes in the table until their carriers are known.
  void add_virtual_bodies() {
    for (const formats::BodySpec& body : scene_.bodies) {
      const auto* spec = std::get_if<formats::VirtualBodySpec>(&body);
      if (spec == nullptr) continue;
      int node = static_cast<int>(markers_.start.size());
      switch (scene_.virtual_bodies) {
        case formats::VirtualBodies::keep:
          node = add_virtual_node(*spec);
          break;
        case formats::VirtualBodies::eliminate:
          markers_.start.push_back(motion_at(spec->start, Vector3d::Zero()));
          virtual_bodies_.push_back(spec);
          break;
      }
      add_place(spec->name, {node});
      for (const formats::RigidNodeSpec& place : spec->nodes)
        add_place(spec->name + "/" + place.name,
                  {node, place.pose.position, place.pose.orientation.normalized().toRotationMatrix()});
    }
  }

  int add_virtual_node(const formats::VirtualBodySpec& spec) {
    ++model_.virtual_nodes;
    return add_node(spec.name, spec.start, Vector3d::Zero(), 1, 1);
  }

  /// Places on virtual bodies become places on their carriers; the joints that tie them vanish.
  void eliminate_virtual_bodies() {
    if (virtual_bodies_.empty()) return;
    const int first = static_cast<int>(model_.nodes.size());
    TiedBodies tied = tie_virtual_bodies(scene_, model_, first, markers_);
    markers_.start.resize(static_cast<std::size_t>(first));
    std::map<int, int> node_of_root;
    for (const int root : tied.roots) node_of_root[first + root] = add_virtual_node(*virtual_bodies_[root]);
    const auto renumber = [&](Marker& marker) {
      if (marker.node >= first) marker.node = node_of_root.at(marker.node);
    };
    for (Marker& pose : tied.pose) renumber(pose);
    for (Tie& tie : tied.ties) {
      renumber(tie.a);
      renumber(tie.b);
    }
    const auto move = [&](Marker& place) {
      if (place.node >= first) place = composed(tied.pose[place.node - first], place);
    };
    for (Place& place : model_.places) move(place.marker);
    for (auto& [name, place] : markers_.places) move(place);
    model_.ties = std::move(tied.ties);
    vanished_ = std::move(tied.vanished);
  }

  // ---- loads
  // ---------------------------------------------------------------------------------------------------------
  void check_load_node(const formats::LoadSpec& spec, const Load& load) const {
    const Node& node = model_.nodes[load.at.node];
    if (spec.kind == formats::LoadKind::moment && !has_rotation(model_, load.at.node))
      throw Error(fmt::format("moment '{}' acts on node '{}', which has no rotations", spec.name, node.name),
                  spec.where, "use forces, or keep the rotations of that node in the superelement");
    if (spec.kind == formats::LoadKind::force && !has_translation(model_, load.at.node))
      throw Error(fmt::format("force '{}' acts on node '{}', which has no translations", spec.name, node.name),
                  spec.where, "use moments, or keep the translations of that node in the superelement");
    if (!has_rotation(model_, load.at.node) &&
        (spec.axes == formats::LoadAxes::body || load.at.p.norm() > 1e-12 * model_.length))
      throw Error(fmt::format("force '{}' {} node '{}', which has no rotations", spec.name,
                              spec.axes == formats::LoadAxes::body ? "follows" : "acts away from", node.name),
                  spec.where,
                  "apply it at the node in world axes, or keep the rotations of that node in the superelement");
  }

  void add_load(const formats::LoadSpec& spec) {
    Load load;
    load.name = spec.name;
    load.kind = spec.kind;
    load.axes = spec.axes;
    load.at = markers_.find(spec.at);
    load.components = spec.components;
    load.where = spec.where;
    if (load.at.node < 0 && load.at.follower < 0)
      throw Error(fmt::format("load '{}' acts on ground", spec.name), spec.where, "name a node of a body");
    if (load.at.node >= 0) check_load_node(spec, load);
    const int index = static_cast<int>(model_.loads.size());
    for (int k = 0; k < 3; ++k)
      note_function(spec.components[k], {ChannelUse::Owner::load, index, k, 0, 0}, model_, breakpoints_);
    model_.loads.push_back(std::move(load));
  }

  // ---- the whole ----------------------------------------------------------------------------------------------------
  void initial_motion() {
    if (markers_.start.empty()) throw Error("the scene has no bodies", scene_.file, "add a body under `bodies:`");
    Vector3d low = markers_.start.front().x, high = low;
    for (const NodeMotion& m : markers_.start) {
      low = low.cwiseMin(m.x);
      high = high.cwiseMax(m.x);
    }
    model_.length = (high - low).norm();
    for (const Place& place : model_.places) model_.length = std::max(model_.length, place.marker.p.norm());
    if (!(model_.length > 0.0)) model_.length = 1.0;
  }

  void finish() {
    model_.sizes.nodes = static_cast<int>(model_.nodes.size());
    model_.sizes.boundary += model_.sizes.modal;
    model_.sizes.internal = model_.internal_offset.back();
    model_.sizes.superelements = static_cast<int>(model_.superelements.size());
    model_.breakpoints.assign(breakpoints_.begin(), breakpoints_.end());
    if (scene_.integrator.step > 0.0) model_.motion_spacing = 0.25 * scene_.integrator.step;
    finish_model(model_, scene_.integrator.linear_solver);
  }

  State initial_state(Model& model) {
    State state(model.sizes);
    state.time() = state.load_time() = scene_.integrator.start;
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
      const NodeMotion& m = markers_.start[i];
      const auto column = static_cast<Eigen::Index>(i);
      state.x().col(column) = m.x;
      state.Q().col(column) = wxyz(Eigen::Quaterniond(m.R).normalized());
      if (model.nodes[i].translation >= 0) state.v().segment<3>(model.nodes[i].translation) = m.xd;
      if (model.nodes[i].rotation >= 0) state.v().segment<3>(model.nodes[i].rotation) = m.Omega;
    }
    for (std::size_t i = 0; i < frames_.size(); ++i) state.frames().col(i) = wxyz(frames_[i]);
    Evaluation evaluation(model);
    measure_start(model, state, evaluation);
    scale(model, state, evaluation);
    return state;
  }

  /// Angles at the start, and the constants that are values at the start.
  static void measure_start(Model& model, State& state, Evaluation& evaluation) {
    evaluate(model, state, evaluation);
    unwrap_hinges(model, evaluation, state);
    update_modal_nodes(model, evaluation);
    evaluate_coordinates(model, state, evaluation);
    for (Coupling& coupling : model.couplings)
      for (const CouplingTerm& term : coupling.terms)
        if (coupling.from_start) coupling.constant += term.factor * evaluation.coordinates[term.coordinate].value;
    for (Spring& spring : model.springs)
      if (spring.free_at_start) spring.free = evaluation.coordinates[spring.coordinate].value;
    for (std::size_t i = 0; i < model.bushings.size(); ++i)
      if (model.bushings[i].free_at_start) model.bushings[i].free = evaluation.bushings[i].deflection;
  }

  /// Largest diagonal entries of mass and stiffness, which the iteration matrix is scaled with.
  static void scale(Model& model, const State& state, Evaluation& evaluation) {
    evaluate(model, state, evaluation);
    MatrixValues matrix(model);
    const auto largest_diagonal = [&](const TangentCoefficients& c) {
      model.mass_scale = model.stiffness_scale = 1.0;
      evaluate_tangent(model, state, {c, TangentKind::step, {}}, evaluation, matrix);
      double largest = 0.0;
      for (int i = 0; i < model.sizes.boundary; ++i) {
        const int slot = model.pattern->slot(i, i);
        largest = std::max(largest, std::abs(matrix.values[slot]) * model.value_scale[slot]);
      }
      return largest;
    };
    const double mass = largest_diagonal({1.0, 0.0, 0.0});
    const double stiffness = largest_diagonal({0.0, 0.0, 1.0});
    model.mass_scale = mass > 0.0 ? mass : 1.0;
    model.stiffness_scale = stiffness;
  }

  const formats::Scene& scene_;
  MirroredFiles<formats::LoadedSuperelement> superelements_;
  MirroredFiles<formats::LoadedModalBody> modal_bodies_;
  Model model_;
  MarkerTable markers_;
  BuiltSuperelements built_superelements_;
  std::vector<Eigen::Quaterniond> frames_;
  std::vector<const formats::VirtualBodySpec*> virtual_bodies_;  ///< to be eliminated
  std::set<std::string> vanished_;                               ///< joints
  std::set<double> breakpoints_;
  std::vector<std::string> notes_;
  std::vector<Error> errors_;
};

}  // namespace

BuiltModel build_model(const formats::Scene& scene, const BodyFiles& files) { return Builder(scene, files).build(); }

}  // namespace tisserand::mechanism
