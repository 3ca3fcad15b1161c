// Results file *.results.h5: blocks over time (formats/RESULTS.md).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/units.hpp"
#include "formats/results/simulated_scene.hpp"

namespace tisserand::formats {

/// What a run stores; fixed before the first row.
struct ResultsLayout {
  std::string scene;  ///< name of the scene
  std::string producer;
  Units units;
  std::vector<std::string> nodes;
  /// A second name, not a second column: columns would be stored twice and match every pattern twice.
  struct Alias {
    std::string name;  ///< "rod/end"
    int node = 0;      ///< the one of `nodes` that it means
  };
  std::vector<Alias> node_aliases;
  std::vector<std::string> superelements;
  std::vector<int> modes_offset;     ///< superelements.size() + 1; into the columns of y
  std::vector<int> boundary_offset;  ///< superelements.size() + 1; into the rows of boundary_force
  std::vector<std::string>
      boundary_nodes;  ///< boundary_offset.back() names of the rows of boundary_force; empty: numbers
  std::vector<int> load_case_offset;     ///< superelements.size() + 1; into load_cases
  std::vector<std::string> load_cases;   ///< of their parts, those that loads of the scene name
  std::vector<std::string> modal_bodies;
  std::vector<int> modal_offset;               ///< modal_bodies.size() + 1; into the columns of w
  std::vector<int> modal_node_offset;          ///< modal_bodies.size() + 1; into modal_nodes
  std::vector<std::string> modal_nodes;        ///< of each modal body those that something acts on, by their own names
  std::vector<std::string> joints;
  struct Coordinate {
    std::string name;     ///< "hinge", or "slide/z" of a joint with several
    bool length = false;  ///< or an angle
  };
  std::vector<Coordinate> coordinates;  ///< joint coordinates
  struct Coupling {
    std::string name;
    bool first_length = false;  ///< the first coordinate is a length, or an angle
    bool second_length = false;
  };
  std::vector<Coupling> couplings;  ///< gears, racks and pinions
  std::vector<Coordinate> motions;  ///< driven coordinates, by the name of the drive
  std::vector<Coordinate> springs;  ///< by name, with the kind of what they act along
  std::vector<Coordinate> stops;    ///< those of the springs that have stops
  std::vector<std::string> bushings;
  std::vector<std::string> frictions;  ///< joints with friction
  std::vector<std::string> tyres;
  bool strained = false;              ///< some superelements have second-order strain: y_strain
  bool treads = false;                ///< some tyres relax: deflections of their treads
  std::vector<Coordinate> loads;      ///< forces (length) and moments (angle)
  struct Quantity {
    std::string name;
    std::string unit;
  };
  std::vector<Quantity> quantities;   ///< `channels` of the scene
  std::vector<std::string> channels;  ///< selection, as in OutputSpec; empty: all
  std::vector<std::string> superelement_content_ids;
  SimulatedScene simulated;
};

/// Motion of the frames of modal bodies, in axes of their parts: acceleration of the origin less gravity, angular
/// velocity and its rate; and what acts on each of layout.modal_nodes, [force; moment about the node].
struct ModalFrames {
  Eigen::Matrix3Xd acceleration, angular_velocity, angular_acceleration;
  Eigen::Matrix<double, 6, Eigen::Dynamic> node_force;
};

/// One instant. World frame unless said; sized once by resize(layout). Joint force and moment: what A's body exerts on
/// B's body, at B's origin, in A's axes; so those of bushings and friction. Boundary force: wrench that each boundary
/// node receives from the rest of the mechanism, world axes.
struct ResultsRow {
  double time = 0.0;
  Eigen::Matrix3Xd node_position, node_velocity, node_angular_velocity, node_acceleration, node_angular_acceleration;
  Eigen::Matrix4Xd node_rotation;  ///< w x y z, Q_WN
  Eigen::Matrix3Xd frame_position;
  Eigen::Matrix4Xd frame_rotation;
  Eigen::VectorXd y;         ///< all superelements, file coordinates, modes_offset
  Eigen::VectorXd y_rate;    ///< of y
  Eigen::VectorXd y_strain;  ///< y with the second-order strain: what stress follows from; empty unless strained
  /// Of floating frames, in axes of the part: acceleration of the origin less gravity, angular velocity, its rate.
  Eigen::Matrix3Xd frame_acceleration, frame_angular_velocity, frame_angular_acceleration;
  Eigen::VectorXd load_factor;                              ///< of layout.load_cases
  Eigen::Matrix<double, 6, Eigen::Dynamic> boundary_force;  ///< [force; moment]
  Eigen::VectorXd w;                                        ///< all modal bodies, modal_offset
  Eigen::VectorXd w_rate;                                   ///< of w
  ModalFrames modal;
  Eigen::Matrix3Xd joint_force, joint_moment;
  Eigen::VectorXd joint_coordinate, joint_rate;                 ///< of layout.coordinates
  Eigen::VectorXd coupling_first_force, coupling_second_force;  ///< along the two coordinates, as of springs
  Eigen::VectorXd motion_force;              ///< of layout.motions: force or moment of the drive along its coordinate
  Eigen::VectorXd spring_force, stop_force;  ///< along the coordinate, on b; the stop's is part of the spring's
  Eigen::Matrix3Xd bushing_force, bushing_moment, friction_force, friction_moment;  ///< as of joints
  Eigen::Matrix3Xd tyre_force, tyre_moment;    ///< on the wheel, about the contact centre, in tyre axes (ISO 8855)
  Eigen::Matrix3Xd tyre_contact, tyre_normal;  ///< contact centre, normal of the road
  Eigen::VectorXd tyre_slip, tyre_slip_angle, tyre_camber, tyre_penetration, tyre_rolling_radius, tyre_adhesion;
  Eigen::Matrix2Xd tyre_deflection,
      tyre_deflection_rate;  ///< of the tread, along and across the wheel; 0 without relaxation
  Eigen::Matrix3Xd load;     ///< force or moment of each load, in its axes: those of the world or of its node
  Eigen::VectorXd quantity;  ///< of layout.quantities
  double kinetic = 0.0, strain = 0.0, potential = 0.0, work = 0.0, dissipated = 0.0, total = 0.0, balance = 0.0;
  double step = 0.0, iterations = 0.0, residual = 0.0, constraint = 0.0;
  bool reactions = true;  ///< whether the layout stores those of joints, drives or gears; set by resize()

  void resize(const ResultsLayout& layout);
};

/// Modes of a linearised scene: per mode (column) the complex shape of each node of the layout, world axes.
struct ModesTable {
  Eigen::VectorXcd eigenvalue;  ///< [1/time]
  Eigen::VectorXd frequency;    ///< |eigenvalue|/2π
  Eigen::VectorXd damping_ratio;
  Eigen::MatrixXcd translation;  ///< 3 nodes x modes
  Eigen::MatrixXcd rotation;
  Eigen::MatrixXcd y;  ///< coordinates of all superelements x modes, as ResultsRow::y
  Eigen::MatrixXcd w;  ///< of all modal bodies x modes
};

/// The first rows of an older file of the same layout, with which a new one begins.
struct ResultsBeginning {
  std::string file;
  std::size_t rows = 0;
};

/// What one row of this layout takes in the file, with its selection.
std::size_t bytes_of_row(const ResultsLayout& layout);

/// Throws Error if a running program writes results under this name.
void require_unheld_results(const std::string& path);

/// Appends rows to <path>.part, flushes about every second, renames to path in finish(). The destructor of an
/// unfinished writer closes the file as a partial one (completed = 0) and leaves it under `path`. Until its end no
/// other writer can take the name: a lock of the kernel on the file, which ends with the program and which readers
/// ignore.
class ResultsWriter {
 public:
  /// Throws Error: cannot be written, held by a running program. Without a path rows are counted and nothing is
  /// written.
  ResultsWriter(const std::string& path, const ResultsLayout& layout);
  /// Begins with a copy of older rows (of no file: none), which their checksums vouch for. The older file stays as it
  /// is until finish() puts the whole one in its place, if it has the same name; a killed one (.part) takes its final
  /// name before.
  ResultsWriter(const std::string& path, const ResultsLayout& layout, const ResultsBeginning& beginning);
  ~ResultsWriter();
  ResultsWriter(const ResultsWriter&) = delete;
  ResultsWriter& operator=(const ResultsWriter&) = delete;

  /// No heap allocation between flushes. Throws Error (disk full, ...).
  void append(const ResultsRow& row);
  /// What was appended is on the disk when this returns.
  void flush();
  /// Rows appended or begun with.
  std::size_t rows() const;
  /// Names this file among all of the same scene; attribute `run`.
  const std::string& run() const;
  /// Keeps modes for finish() to write.
  void set_modes(ModesTable modes);
  /// Removes what was written; an older file of this name stays as it is.
  void discard();
  /// Writes the run report (JSON text), sets completed and reason ("" if completed), closes and renames.
  void finish(bool completed, const std::string& reason, const std::string& report_json);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// What the rows of a channel are: instants, or the modes of a linearised scene.
enum class Rows { instants, modes };

/// One scalar column of a results file, e.g. "nodes/position/beam/tip/x", "modes/frequency".
struct Channel {
  std::string name;
  std::string unit;
  Rows rows = Rows::instants;
  std::string same_as;  ///< the channel that this name means too ("nodes/position/rod/10/x"); empty: itself
};

/// The file itself, or <path>.part of an unfinished run if only that is there.
std::string existing_results(const std::string& path);

class ResultsReader {
 public:
  explicit ResultsReader(const std::string& path);  ///< accepts partial files
  ~ResultsReader();

  std::string path() const;  ///< of the file that is read; ends in .part if only that is there
  bool completed() const;
  std::string reason() const;
  std::string report_json() const;
  std::string scene() const;
  const ResultsLayout& layout() const;  ///< what is stored; `simulated` is empty before version 1.5
  std::string version() const;          ///< of the format, "1.10"
  std::string run() const;              ///< ResultsWriter::run(); empty before version 1.4
  std::size_t rows() const;
  std::size_t modes() const;  ///< 0: the file holds none
  std::vector<double> time() const;
  /// Those over time, then other names of some of them, then those over modes.
  const std::vector<Channel>& channels() const;
  /// Values over time. Throws Error with the nearest channel names if there is none of that name.
  std::vector<double> read(const std::string& channel) const;
  /// Rows [first, first + count) of several channels, count x channels.size(); each dataset is read once.
  /// All of instants or all of modes.
  Eigen::MatrixXd read_rows(const std::vector<std::string>& channels, std::size_t first, std::size_t count) const;
  /// The given rows, ascending, of a whole dataset ("nodes/position"): rows.size() x its columns; of none that is
  /// stored: without columns.
  Eigen::MatrixXd read_dataset(const std::string& dataset, const std::vector<std::size_t>& rows) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Names of the channels that a selection means: exact names, groups and datasets ("nodes", "nodes/position"), patterns
/// with
/// * (any run of characters, also /). Empty: all. In the order of the file; another name of a channel only where the
/// entry does not mean the channel itself. Throws Error for an entry that means none.
std::vector<Channel> select_channels(const std::vector<Channel>& channels, const std::vector<std::string>& selection,
                                     const std::string& where);

/// CSV with one header line "time [s],name [unit],...", or "mode,modes/frequency [Hz],..." for channels of modes,
/// counted from 1; empty selection: the modes of a file that holds some, else all channels over time. Wildcards * are
/// allowed. Throws Error for instants and modes in one selection.
void export_csv(const ResultsReader& reader, const std::vector<std::string>& selection, const std::string& path);

}  // namespace tisserand::formats
