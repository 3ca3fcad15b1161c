// SPDX-License-Identifier: GPL-3.0-or-later
// Results file *.results.h5: blocks over time (formats/RESULTS.md).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/units.hpp"
#include "formats/results/simulated_scene.hpp"

namespace tisserand::formats {

/// Contents of the file of a run, fixed before the first row.
struct ResultsLayout {
  std::string scene;  ///< name of the scene
  std::string producer;
  Units units;
  std::vector<std::string> nodes;
  /// A second name, not a second column: columns would be stored twice and match every pattern twice.
  struct Alias {
    std::string name;  ///< "rod/end"
    int node = 0;      ///< its index in `nodes`
  };
  std::vector<Alias> node_aliases;
  std::vector<std::string> superelements;
  std::vector<int> modes_offset;     ///< superelements.size() + 1 offsets into the columns of y
  std::vector<int> boundary_offset;  ///< superelements.size() + 1 offsets into the rows of boundary_force
  std::vector<std::string>
      boundary_nodes;                   ///< boundary_offset.back() names of the rows of boundary_force; empty: numbers
  std::vector<int> load_case_offset;    ///< superelements.size() + 1 offsets into load_cases
  std::vector<std::string> load_cases;  ///< load cases of the parts that loads of the scene use
  std::vector<std::string> modal_bodies;
  std::vector<int> modal_offset;         ///< modal_bodies.size() + 1 offsets into the columns of w
  std::vector<int> modal_node_offset;    ///< modal_bodies.size() + 1 offsets into modal_nodes
  std::vector<std::string> modal_nodes;  ///< loaded nodes of each modal body, by their own names
  std::vector<std::string> joints;
  struct Coordinate {
    std::string name;     ///< "hinge", or "slide/z" for a joint with several
    bool length = false;  ///< true: a length; false: an angle
  };
  std::vector<Coordinate> coordinates;  ///< joint coordinates
  struct Coupling {
    std::string name;
    bool first_length = false;  ///< the first coordinate is a length (false: an angle)
    bool second_length = false;
  };
  std::vector<Coupling> couplings;  ///< gears, racks and pinions
  std::vector<Coordinate> motions;  ///< driven coordinates, by the name of the drive
  std::vector<Coordinate> springs;  ///< by name; kind of the coordinate along which they act
  std::vector<Coordinate> stops;    ///< springs with stops
  std::vector<std::string> bushings;
  std::vector<std::string> frictions;  ///< joints with friction
  std::vector<std::string> tyres;
  bool strained = false;          ///< some superelements have second-order strain: y_strain
  std::vector<int> stiffened;     ///< of each superelement: 1 with stiffening, 0 without; empty before version 1.13
  bool treads = false;            ///< some tyres relax: tread deflections
  std::vector<Coordinate> loads;  ///< forces (length) and moments (angle)
  struct Quantity {
    std::string name;
    std::string unit;
  };
  std::vector<Quantity> quantities;   ///< `channels` of the scene
  std::vector<std::string> channels;  ///< selection, as in OutputSpec; empty: all
  std::vector<std::string> superelement_content_ids;
  SimulatedScene simulated;

  /// Whether a superelement has stiffening; nothing in files before version 1.13.
  std::optional<bool> is_stiffened(std::size_t superelement) const {
    return stiffened.empty() ? std::nullopt : std::optional(stiffened[superelement] != 0);
  }
};

/// Motion of the frames of modal bodies, in axes of their parts (acceleration of the origin less gravity, angular
/// velocity and acceleration), and loads [force; moment about the node] on each of layout.modal_nodes.
struct ModalFrames {
  Eigen::Matrix3Xd acceleration, angular_velocity, angular_acceleration;
  Eigen::Matrix<double, 6, Eigen::Dynamic> node_force;
};

/// Values at one instant, sized once by resize(layout). World frame unless stated. Forces and moments of joints,
/// bushings and friction act from A's body on B's body, at B's origin, in A's axes. Boundary force: wrench on each
/// boundary node from the rest of the mechanism, world axes.
struct ResultsRow {
  double time = 0.0;
  Eigen::Matrix3Xd node_position, node_velocity, node_angular_velocity, node_acceleration, node_angular_acceleration;
  Eigen::Matrix4Xd node_rotation;  ///< w x y z, Q_WN
  Eigen::Matrix3Xd frame_position;
  Eigen::Matrix4Xd frame_rotation;
  Eigen::VectorXd y;         ///< all superelements, file coordinates, modes_offset
  Eigen::VectorXd y_rate;    ///< rates of y
  Eigen::VectorXd y_strain;  ///< y with second-order strain, for stresses; empty unless strained
  /// Motion of floating frames, in axes of the part: acceleration of the origin less gravity, angular velocity, its
  /// rate.
  Eigen::Matrix3Xd frame_acceleration, frame_angular_velocity, frame_angular_acceleration;
  Eigen::VectorXd load_factor;                              ///< factors of layout.load_cases
  Eigen::Matrix<double, 6, Eigen::Dynamic> boundary_force;  ///< [force; moment]
  Eigen::VectorXd w;                                        ///< all modal bodies, modal_offset
  Eigen::VectorXd w_rate;                                   ///< rates of w
  ModalFrames modal;
  Eigen::Matrix3Xd joint_force, joint_moment;
  Eigen::VectorXd joint_coordinate, joint_rate;                 ///< of layout.coordinates
  Eigen::VectorXd coupling_first_force, coupling_second_force;  ///< along the two coordinates, as for springs
  Eigen::VectorXd motion_force;                                 ///< force or moment of each drive of layout.motions
  Eigen::VectorXd spring_force, stop_force;  ///< along the coordinate, on b; stops are part of springs
  Eigen::Matrix3Xd bushing_force, bushing_moment, friction_force, friction_moment;  ///< as for joints
  Eigen::Matrix3Xd tyre_force, tyre_moment;    ///< on the wheel, about the contact centre, in tyre axes (ISO 8855)
  Eigen::Matrix3Xd tyre_contact, tyre_normal;  ///< contact centre, normal of the road
  Eigen::VectorXd tyre_slip, tyre_slip_angle, tyre_camber, tyre_penetration, tyre_rolling_radius, tyre_adhesion;
  Eigen::Matrix2Xd tyre_deflection,
      tyre_deflection_rate;  ///< of the tread, along and across the wheel; 0 without relaxation
  Eigen::Matrix3Xd load;     ///< force or moment of each load, in axes of the world or its node
  Eigen::VectorXd quantity;  ///< values of layout.quantities
  double kinetic = 0.0, strain = 0.0, potential = 0.0, work = 0.0, dissipated = 0.0, total = 0.0, balance = 0.0;
  double step = 0.0, iterations = 0.0, residual = 0.0, constraint = 0.0;
  bool reactions = true;  ///< whether the layout stores reactions of joints, drives or gears; set by resize()

  void resize(const ResultsLayout& layout);
};

/// Modes of a linearised scene. Each column is a mode: complex shape of the nodes of the layout, world axes.
struct ModesTable {
  Eigen::VectorXcd eigenvalue;  ///< [1/time]
  Eigen::VectorXd frequency;    ///< |eigenvalue|/2π
  Eigen::VectorXd damping_ratio;
  Eigen::MatrixXcd translation;  ///< 3 nodes x modes
  Eigen::MatrixXcd rotation;
  Eigen::MatrixXcd y;  ///< coordinates of all superelements x modes, as ResultsRow::y
  Eigen::MatrixXcd w;  ///< coordinates of all modal bodies x modes
};

/// First rows of an older file of the same layout, which a new file begins with.
struct ResultsBeginning {
  std::string file;
  std::size_t rows = 0;
};

/// Bytes of one row in the file for this layout and its selection.
std::size_t bytes_of_row(const ResultsLayout& layout);

/// Throws Error if a running program writes results under this name.
void require_unheld_results(const std::string& path);

/// Appends rows to <path>.part, flushes about every second, renames the file to `path` in finish(). The destructor of
/// an unfinished writer closes it as a partial file (completed = 0) and leaves it under `path`. A kernel lock on the
/// file, which readers ignore, keeps other writers from the name until the program ends.
class ResultsWriter {
 public:
  /// Throws Error if the file cannot be written or another program holds it. Without a path, rows are only counted.
  ResultsWriter(const std::string& path, const ResultsLayout& layout);
  /// Begins with a copy of older rows (none without a file), which their checksums verify. The older file is unchanged
  /// until finish() replaces it, if it has the same name. A killed one (.part) gets its final name first.
  ResultsWriter(const std::string& path, const ResultsLayout& layout, const ResultsBeginning& beginning);
  ~ResultsWriter();
  ResultsWriter(const ResultsWriter&) = delete;
  ResultsWriter& operator=(const ResultsWriter&) = delete;

  /// Appends a row, without heap allocation between flushes. Throws Error (disk full, ...).
  void append(const ResultsRow& row);
  /// Waits until all appended rows are on the disk.
  void flush();
  /// Number of rows that were appended or copied at the beginning.
  std::size_t rows() const;
  /// Identity of this file among all of the same scene (attribute `run`).
  const std::string& run() const;
  /// Keeps modes for finish() to write.
  void set_modes(ModesTable modes);
  /// Removes the unfinished file. An older file of this name is unchanged.
  void discard();
  /// Writes the run report (JSON text), sets completed and reason ("" if completed), closes and renames.
  void finish(bool completed, const std::string& reason, const std::string& report_json);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Meaning of the rows of a channel: instants, or modes of a linearised scene.
enum class Rows { instants, modes };

/// One scalar column of a results file, e.g. "nodes/position/beam/tip/x", "modes/frequency".
struct Channel {
  std::string name;
  std::string unit;
  Rows rows = Rows::instants;
  std::string same_as;  ///< other name for the same channel ("nodes/position/rod/10/x"); empty: none
};

/// `path`, or <path>.part of an unfinished run if only that exists.
std::string existing_results(const std::string& path);

class ResultsReader {
 public:
  explicit ResultsReader(const std::string& path);  ///< accepts partial files
  ~ResultsReader();

  std::string path() const;  ///< path of the file; ends in .part if only that exists
  bool completed() const;
  std::string reason() const;
  std::string report_json() const;
  std::string scene() const;
  const ResultsLayout& layout() const;  ///< contents of the file; `simulated` is empty before version 1.5
  std::string version() const;          ///< version of the format, "1.10"
  std::string run() const;              ///< ResultsWriter::run(); empty before version 1.4
  std::size_t rows() const;
  std::size_t modes() const;  ///< number of modes; 0: none stored
  std::vector<double> time() const;
  /// Channels over time, then aliases of some of them, then channels over modes.
  const std::vector<Channel>& channels() const;
  /// Values over time. Throws Error with the nearest channel names if the name is unknown.
  std::vector<double> read(const std::string& channel) const;
  /// Rows [first, first + count) of several channels, count x channels.size(), all over instants or all over modes.
  /// Each dataset is read once.
  Eigen::MatrixXd read_rows(const std::vector<std::string>& channels, std::size_t first, std::size_t count) const;
  /// The given ascending rows of a whole dataset ("nodes/position"): rows.size() x its columns; no columns if it is not
  /// stored.
  Eigen::MatrixXd read_dataset(const std::string& dataset, const std::vector<std::size_t>& rows) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Channels that a selection names: exact names, groups and datasets ("nodes", "nodes/position"), patterns with * (any
/// characters, also /). Empty: all. The order is that of the file. An alias is included only if the entry does not
/// select the channel itself. Throws Error for an entry that selects nothing.
std::vector<Channel> select_channels(const std::vector<Channel>& channels, const std::vector<std::string>& selection,
                                     const std::string& where);

/// Writes CSV with one header line "time [s],name [unit],..." or, for modes counted from 1, "mode,modes/frequency
/// [Hz],...". An empty selection means the modes if the file has some, else all channels over time. Wildcards * are
/// allowed. Throws Error if a selection mixes instants and modes.
void export_csv(const ResultsReader& reader, const std::vector<std::string>& selection, const std::string& path);

}  // namespace tisserand::formats
