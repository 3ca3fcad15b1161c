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

/// Layout of the results file of a run: names of its columns in their order, fixed before the first row.
struct ResultsLayout {
  std::string scene;  ///< name of the scene
  std::string producer;
  Units units;
  std::vector<std::string> nodes;
  /// Second name of a node. It is no second column: columns would be stored twice and match every pattern twice.
  struct Alias {
    std::string name;  ///< "rod/end"
    int node = 0;      ///< index of the node in ResultsLayout::nodes
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
  std::vector<std::string> modal_nodes;  ///< names of the loaded nodes of each modal body, without the body's name
  std::vector<std::string> joints;
  /// Name of a stored coordinate, and whether it is a length or an angle.
  struct Coordinate {
    std::string name;     ///< "hinge", or "slide/z" for a joint with several
    bool length = false;  ///< true: a length; false: an angle
  };
  std::vector<Coordinate> coordinates;  ///< joint coordinates
  /// Name of a coupling of two coordinates, and whether each of them is a length or an angle.
  struct Coupling {
    std::string name;
    bool first_length = false;  ///< the first coordinate is a length (false: an angle)
    bool second_length = false;
  };
  std::vector<Coupling> couplings;  ///< gears, racks and pinions
  std::vector<Coordinate> motions;  ///< driven coordinates; the name is that of the drive
  std::vector<Coordinate> springs;  ///< springs; `length` is that of the coordinate along which they act
  std::vector<Coordinate> stops;    ///< springs with stops
  std::vector<std::string> bushings;
  std::vector<std::string> frictions;  ///< joints with friction
  std::vector<std::string> tyres;
  bool strained = false;          ///< some superelements have second-order strain: y_strain is stored
  std::vector<int> stiffened;     ///< per superelement 1 with stiffening, 0 without; empty before version 1.13
  bool treads = false;            ///< some tyres have relaxation lengths: tread deflections are stored
  std::vector<Coordinate> loads;  ///< loads; `length` is true for a force and false for a moment
  /// Name and unit of a quantity that the scene defines under `channels`.
  struct Quantity {
    std::string name;
    std::string unit;
  };
  std::vector<Quantity> quantities;   ///< `channels` of the scene
  std::vector<std::string> channels;  ///< selection, as in OutputSpec; empty: all
  std::vector<std::string> superelement_content_ids;
  SimulatedScene simulated;

  /// Whether the superelement with this index has stiffening; nothing in files before version 1.13.
  std::optional<bool> is_stiffened(std::size_t superelement) const {
    return stiffened.empty() ? std::nullopt : std::optional(stiffened[superelement] != 0);
  }
};

/// Motion of the floating frames of modal bodies, and the loads on their nodes, in axes of each body's part. The
/// acceleration is that of the frame's origin, less gravity. `node_force` holds [force; moment about the node] for each
/// of layout.modal_nodes.
struct ModalFrames {
  Eigen::Matrix3Xd acceleration, angular_velocity, angular_acceleration;
  Eigen::Matrix<double, 6, Eigen::Dynamic> node_force;
};

/// Values at one instant, sized once by resize(layout), in the world frame unless stated. Forces and moments of joints,
/// bushings and friction act from the body of marker A on the body of marker B, at the origin of B, in axes of A.
/// `boundary_force` is the load [force; moment] of the rest of the mechanism on each boundary node, in world axes.
struct ResultsRow {
  double time = 0.0;
  Eigen::Matrix3Xd node_position, node_velocity, node_angular_velocity, node_acceleration, node_angular_acceleration;
  Eigen::Matrix4Xd node_rotation;  ///< quaternions w x y z of the rotations from node to world axes
  Eigen::Matrix3Xd frame_position;
  Eigen::Matrix4Xd frame_rotation;
  Eigen::VectorXd y;         ///< coordinates of all superelements as in their files; offsets: modes_offset
  Eigen::VectorXd y_rate;    ///< rates of y
  Eigen::VectorXd y_strain;  ///< y with second-order strain, for stresses; empty unless layout.strained
  /// Motion of the floating frames of superelements, in part axes: acceleration of the origin less gravity, angular
  /// velocity, angular acceleration.
  Eigen::Matrix3Xd frame_acceleration, frame_angular_velocity, frame_angular_acceleration;
  Eigen::VectorXd load_factor;                              ///< factors of layout.load_cases
  Eigen::Matrix<double, 6, Eigen::Dynamic> boundary_force;  ///< [force; moment]
  Eigen::VectorXd w;       ///< modal coordinates of all modal bodies; offsets: modal_offset
  Eigen::VectorXd w_rate;  ///< rates of w
  ModalFrames modal;
  Eigen::Matrix3Xd joint_force, joint_moment;
  Eigen::VectorXd joint_coordinate, joint_rate;                 ///< values and rates of layout.coordinates
  Eigen::VectorXd coupling_first_force, coupling_second_force;  ///< along the first and the second coordinate of a gear
  Eigen::VectorXd motion_force;                                 ///< force or moment of each drive of layout.motions
  Eigen::VectorXd spring_force, stop_force;  ///< along the coordinate, on marker b; a spring's force includes its stops
  Eigen::Matrix3Xd bushing_force, bushing_moment, friction_force, friction_moment;  ///< from A on B, as for joints
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

/// Modes of a linearised scene. Each column is a mode: its complex shape at the nodes of the layout, in world axes.
struct ModesTable {
  Eigen::VectorXcd eigenvalue;  ///< [1/time]
  Eigen::VectorXd frequency;    ///< |eigenvalue|/2π
  Eigen::VectorXd damping_ratio;
  Eigen::MatrixXcd translation;  ///< (3 nodes x modes)
  Eigen::MatrixXcd rotation;
  Eigen::MatrixXcd y;  ///< (coordinates of all superelements x modes), as ResultsRow::y
  Eigen::MatrixXcd w;  ///< (coordinates of all modal bodies x modes)
};

/// Beginning of a new results file: the first `rows` rows of an older file of equal layout.
struct ResultsBeginning {
  std::string file;
  std::size_t rows = 0;
};

/// Number of bytes of one row in a file with this layout and its selection layout.channels.
std::size_t bytes_of_row(const ResultsLayout& layout);

/// Throws Error if a running program is writing results to `path`.
void require_unheld_results(const std::string& path);

/// Writer of a results file. It appends rows to <path>.part, flushes about every second, and renames the file to `path`
/// in finish(). Without finish(), the destructor closes it as a partial file (completed = 0) under `path`. A kernel
/// lock, which readers ignore, keeps other writers from the name until the program ends.
class ResultsWriter {
 public:
  /// Opens the file. Throws Error if it cannot be written or another program holds it. If `path` is empty, rows are
  /// only counted.
  ResultsWriter(const std::string& path, const ResultsLayout& layout);
  /// Begins with a copy of the older rows, which their checksums verify. An empty name of the older file means no rows.
  /// An older file with the name `path` stays unchanged until finish() replaces it. A file <path>.part of a killed run
  /// is first renamed to `path`.
  ResultsWriter(const std::string& path, const ResultsLayout& layout, const ResultsBeginning& beginning);
  ~ResultsWriter();
  ResultsWriter(const ResultsWriter&) = delete;
  ResultsWriter& operator=(const ResultsWriter&) = delete;

  /// Appends a row. Between flushes it allocates no heap memory. Throws Error (disk full, ...).
  void append(const ResultsRow& row);
  /// Waits until all appended rows are on the disk.
  void flush();
  /// Number of rows that were appended or copied at the beginning.
  std::size_t rows() const;
  /// Identifier of this run among all runs of a scene, stored as the attribute `run`.
  const std::string& run() const;
  /// Stores modes in memory; finish() writes them to the file.
  void set_modes(ModesTable modes);
  /// Removes the unfinished file. An older file named `path` stays unchanged.
  void discard();
  /// Writes the run report (JSON text) and the attributes completed and reason ("" if completed), closes the file and
  /// renames it.
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

/// Name of an existing results file: `path`, or <path>.part of an unfinished run if only that exists.
std::string existing_results(const std::string& path);

/// Reader of a results file. Throws Error for a missing or damaged file.
class ResultsReader {
 public:
  explicit ResultsReader(const std::string& path);  ///< accepts partial files
  ~ResultsReader();

  std::string path() const;  ///< path of the file; ends in .part for an unfinished run
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
  /// All channels of the file: those over time, then aliases of some of them, then those over modes.
  const std::vector<Channel>& channels() const;
  /// Values of a channel, one per row. Throws Error with the nearest channel names if the name is unknown.
  std::vector<double> read(const std::string& channel) const;
  /// Rows [first, first + count) of several channels (count x channels.size()). Requires that the rows of all channels
  /// are instants, or of all are modes. Each dataset is read once.
  Eigen::MatrixXd read_rows(const std::vector<std::string>& channels, std::size_t first, std::size_t count) const;
  /// Given rows of a whole dataset such as "nodes/position" (rows.size() x columns of the dataset). Requires ascending
  /// `rows`. The result has no columns if the dataset is not stored.
  Eigen::MatrixXd read_dataset(const std::string& dataset, const std::vector<std::size_t>& rows) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Channels that a selection names: exact names, groups and datasets ("nodes", "nodes/position"), patterns with * (any
/// characters, also /). An empty selection means all. The order is that of the file. An alias is included only if the
/// entry does not select the channel itself. Throws Error for an entry that selects nothing.
std::vector<Channel> select_channels(const std::vector<Channel>& channels, const std::vector<std::string>& selection,
                                     const std::string& where);

/// Writes channels as CSV. The header line is "time [s],name [unit],..." or, for modes counted from 1,
/// "mode,modes/frequency [Hz],...". An empty selection means the modes if the file has some, else all channels over
/// time. Wildcards * are allowed. Throws Error if a selection mixes instants and modes.
void export_csv(const ResultsReader& reader, const std::vector<std::string>& selection, const std::string& path);

}  // namespace tisserand::formats
