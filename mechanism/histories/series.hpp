// SPDX-License-Identifier: GPL-3.0-or-later
// Named histories from results files and CSV files for `plot` and `compare`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formats/results/results.hpp"

namespace tisserand::mechanism {

enum class SeriesKind {
  run,
  reference,
  difference,  ///< run minus its reference
  front,     ///< bound of other series: wide and grey beneath them
  backdrop,  ///< other series for comparison: small grey points beneath
  marks      ///< single events: crosses on top
};

/// Norms of the difference of two histories, at the instants from `from` to `to`.
struct Deviation {
  double largest = 0.0;         ///< max |y - y_ref|
  double rms = 0.0;             ///< sqrt(∫(y - y_ref)² dt / ∫dt), trapezoid rule
  double reference_rms = 0.0;   ///< rms of y_ref alone
  double from = 0.0, to = 0.0;  ///< first and last instant compared
  std::size_t instants = 0;
};

/// One quantity as a function of another, in the units of its file.
struct Series {
  SeriesKind kind = SeriesKind::run;
  std::string source;           ///< label of the file: given by the user, else the file name without endings
  std::string channel;          ///< "nodes/position/beam/tip/x", or the column of a CSV file
  std::string unit;             ///< "" if unnamed or unknown
  std::string x_name = "time";  ///< "mode": x counts the modes of a linearised scene from 1
  std::string x_unit;
  std::vector<double> x;
  std::vector<double> y;
  bool has_own_label = false;  ///< whether the user gave `source`
  bool is_of_run = false;      ///< for a reference: it is a channel of a results file
  Deviation norms;             ///< norms of a difference
};

/// Two columns of a CSV file with a header line.
struct ReferenceColumn {
  std::string file;
  std::string x;
  std::string y;
  std::string label;
};

/// A results file for comparison, channel by channel.
struct ComparedRun {
  std::string file;
  std::string label;
};

struct SeriesRequest {
  std::vector<std::string> files;     ///< *.results.h5, also of interrupted runs
  std::vector<std::string> labels;    ///< labels of the files in their order; missing ones: the file names
  std::vector<std::string> channels;  ///< names, groups such as "nodes/position", or patterns with *
  std::vector<ReferenceColumn> references;
  std::vector<ComparedRun> reference_runs = {};
};

/// Parses "file.csv:x column:y column[:label]"; the label may contain colons. Throws Error that shows the form.
ReferenceColumn parse_reference(const std::string& text);

/// Parses "other.results.h5[:label]"; empty if the text does not name a results file.
std::optional<ComparedRun> parse_reference_run(const std::string& text);

/// Reads two columns. A header cell "name [unit]" is also found by "name", any cell by its number from 1. Rows in which
/// either cell is empty or nan are omitted. Throws Error with file:line:column, or with the names of similar columns.
Series read_reference(const ReferenceColumn& column);

/// Reads all series of a request: the channels of each file in order, then the references. These are columns, and the
/// chosen channels of reference runs. A channel may be missing in some of the files, because a node has other names in
/// other models. Throws Error if it is missing in all files, if a file has no channel, or if the request is empty.
std::vector<Series> read_series(const SeriesRequest& request);

/// File name without folders and endings such as ".results.h5" and ".csv".
std::string stem(const std::string& path);

}  // namespace tisserand::mechanism
