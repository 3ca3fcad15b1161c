// Data: the legal keys of scene.yaml.
#include "formats/scene/keys.hpp"

#include "formats/sections/reader.hpp"

namespace tisserand::formats {

std::vector<KeySet> scene_key_sets() {
  std::vector<KeySet> sets{
      {"scene",
       {"scene",    "units",      "gravity",           "materials",  "sections", "bodies",     "joints",
        "inputs",   "channels",   "motions",           "springs",    "bushings", "loads",      "analysis",
        "analyses", "integrator", "statics",           "modes",      "output",   "checkpoint", "virtual_bodies",
        "include",  "parameters", "initial_tolerance", "assemblies", "instances"}},
      {"assembly",
       {"assembly", "parameters", "assemblies", "instances", "materials", "sections", "bodies", "joints", "inputs",
        "channels", "motions", "springs", "bushings", "loads"}},
      {"instance", {"use", "pose", "mirror", "parameters", "count", "step", "first"}},
      {"analysis", {"type", "from", "integrator", "statics", "modes", "output", "checkpoint"}},
      {"units", {"length", "mass", "time"}},
      {"pose", {"position", "orientation"}},
      {"orientation", {"axis", "angle_deg", "x", "y", "z"}},
      {"body_superelement",
       {"type", "file", "mirror", "use", "modes", "cutoff", "inertia", "frame", "weights", "damping", "pose",
        "velocity", "angular_velocity", "gravity"}},
      {"frame", {"node"}},
      {"weights", {"positions", "rotations"}},
      {"damping", {"mass", "stiffness", "ratio", "ratios"}},
      {"body_rigid",
       {"type", "mass", "center_of_mass", "inertia", "nodes", "pose", "velocity", "angular_velocity", "gravity"}},
      {"body_rigid_from", {"type", "from", "mirror", "pose", "velocity", "angular_velocity", "gravity"}},
      {"body_virtual", {"type", "nodes", "pose", "velocity", "angular_velocity"}},
      {"body_modal",
       {"type", "file", "mirror", "modes", "cutoff", "damping", "pose", "velocity", "angular_velocity", "gravity"}},
      {"body_beam",
       {"type", "from", "to", "through", "orientation", "elements", "nodes_per_element", "section", "material", "pose",
        "velocity", "angular_velocity", "gravity"}},
      {"joint", {"type", "a", "b", "axis", "x_axis", "position", "hold", "pitch", "length", "friction"}},
      {"friction", {"coefficient", "static_coefficient", "velocity", "radius", "arm"}},
      {"gear", {"type", "between", "ratio"}},
      {"rack_and_pinion", {"type", "between", "radius"}},
      {"input", {"file", "time", "value", "interpolation"}},
      {"channel", {"type", "of", "axis", "origin", "a", "b"}},
      {"motion", {"coordinate", "value"}},
      {"spring",
       {"type", "coordinate", "a", "b", "axis", "x_axis", "stiffness", "damping", "free", "lower", "upper",
        "stop_stiffness", "stop_damping", "force"}},
      {"curve", {"table", "file", "interpolation"}},
      {"bushing", {"a", "b", "position", "axis", "x_axis", "stiffness", "damping", "free", "preload"}},
      {"marker", {"node", "position", "orientation"}},
      {"load", {"type", "at", "axes", "value"}},
      {"time_function", {"table", "file", "expression", "breakpoints"}},
      {"integrator",
       {"method", "rho", "alpha", "formulation", "step", "start", "end", "tolerance", "constraint_tolerance",
        "max_iterations", "max_halvings", "linear_solver", "error_control", "relative_tolerance", "absolute_tolerance",
        "stabilisation", "baumgarte"}},
      {"error_control", {"tolerance", "absolute", "min_step", "max_step"}},
      {"baumgarte", {"alpha", "beta"}},
      {"statics", {"rotation", "load_steps", "tolerance", "max_iterations"}},
      {"steady_rotation", {"angular_velocity", "about"}},
      {"modes", {"count", "rotation"}},
      {"checkpoint", {"every", "interval"}},
      {"output", {"every", "interval", "from", "channels"}}};
  for (KeySet& set : section_key_sets()) sets.push_back(std::move(set));
  return sets;
}

}  // namespace tisserand::formats
