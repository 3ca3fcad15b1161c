// SPDX-License-Identifier: GPL-3.0-or-later
// Named histories from results files and CSV files for `plot` and `compare`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formats/results/results.hpp"

namespace tisserand::mechanism {

/// Kind of a series, which determines how a picture shows it.
enum class SeriesKind {
  run,
  reference,
  difference,  ///< difference of a run and its reference
  front,       ///< bound of other series: wide and grey beneath them
  backdrop,    ///< other series for comparison: small grey points beneath
  marks        ///< single events: crosses on top
};

/// Norms of the difference y - y_ref of two histories, over the instants from `from` to `to`.
struct Deviation {
  double largest = 0.0;         ///< largest difference, max |y - y_ref|
  double rms = 0.0;             ///< root mean square sqrt(∫(y - y_ref)² dt / ∫dt), trapezoid rule
  double reference_rms = 0.0;   ///< root mean square of y_ref alone
  double from = 0.0, to = 0.0;  ///< first and last instant compared
  std::size_t instants = 0;
};

/// Curve: one quantity y as a function of another quantity x, in the units of its file.
struct Series {
  SeriesKind kind = SeriesKind::run;
  std::string source;           ///< label of the file: given by the user, else the file name without endings
  std::string channel;          ///< name "nodes/position/beam/tip/x", or name of the column of a CSV file
  std::string unit;             ///< unit of y; empty if unnamed or unknown
  std::string x_name = "time";  ///< name of x; "mode": x counts the modes of a linearised scene from 1
  std::string x_unit;
  std::vector<double> x;
  std::vector<double> y;
  bool has_own_label = false;  ///< whether the user gave `source`
  bool is_of_run = false;      ///< for a reference: whether it is a channel of a results file
  Deviation norms;             ///< norms of a difference
};

/// Reference from a CSV file with a header line: names of the file and of two columns, x and y.
struct ReferenceColumn {
  std::string file;
  std::string x;
  std::string y;
  std::string label;
};

/// Results file that serves as a reference, channel by channel.
struct ComparedRun {
  std::string file;
  std::string label;
};

/// Request for series: results files, their channels, and references.
struct SeriesRequest {
  std::vector<std::string> files;     ///< paths of results files *.results.h5, also of interrupted runs
  std::vector<std::string> labels;    ///< labels of the files in their order; missing ones: the file names
  std::vector<std::string> channels;  ///< channels: names, groups such as "nodes/position", or patterns with *
  std::vector<ReferenceColumn> references;
  std::vector<ComparedRun> reference_runs = {};
};

/// Parses the text "file.csv:x column:y column[:label]" of a reference. The label may contain colons. Throws Error that
/// shows the form.
ReferenceColumn parse_reference(const std::string& text);

/// Parses the text "other.results.h5[:label]" of a reference; absent if the text does not name a results file.
std::optional<ComparedRun> parse_reference_run(const std::string& text);

/// Reads two columns of a CSV file as a reference. A column is found by its header cell "name [unit]" or by "name"
/// alone, else by its number from 1. Rows in which one of the two cells is empty or nan are omitted. Throws Error with
/// file and line, or with the names of similar columns.
Series read_reference(const ReferenceColumn& column);

/// Reads all series of a request: the channels of each results file in order, then the references. References are the
/// chosen channels of reference runs, then columns of CSV files. A channel may be missing in some of the files, because
/// a node has other names in other models. Throws Error if it is missing in all files, if a file has none of the
/// channels, or if the request is empty.
std::vector<Series> read_series(const SeriesRequest& request);

/// File name without folders and endings such as ".results.h5" and ".csv".
std::string stem(const std::string& path);

}  // namespace tisserand::mechanism
