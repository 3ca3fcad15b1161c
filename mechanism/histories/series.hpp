// Named histories from results files and CSV files: what `plot` and `compare` look at.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formats/results/results.hpp"

namespace tisserand::mechanism {

enum class SeriesKind {
  run,
  reference,
  difference,  ///< of a run from its reference
  front,     ///< a bound of others: wide and grey beneath them
  backdrop,  ///< others for comparison: small grey points beneath
  marks      ///< single events: crosses above
};

/// Differences of one history from another one, at the instants from `from` to `to`.
struct Deviation {
  double largest = 0.0;         ///< max |y - y_ref|
  double rms = 0.0;             ///< sqrt(∫(y - y_ref)² dt / ∫dt), trapezoid rule
  double reference_rms = 0.0;   ///< the same of y_ref alone
  double from = 0.0, to = 0.0;  ///< first and last instant compared
  std::size_t instants = 0;
};

/// One quantity over another, in the units of its file.
struct Series {
  SeriesKind kind = SeriesKind::run;
  std::string source;           ///< label of the file: its own label, else the file name without endings
  std::string channel;          ///< "nodes/position/beam/tip/x", or the column of a CSV file
  std::string unit;             ///< "" if unnamed or unknown
  std::string x_name = "time";  ///< "mode": x counts the modes of a linearised scene from 1
  std::string x_unit;
  std::vector<double> x;
  std::vector<double> y;
  bool has_own_label = false;  ///< `source` was chosen by the user
  bool is_of_run = false;      ///< of a reference: a channel of a results file
  Deviation norms;             ///< of a difference
};

/// Two columns of a CSV file with a header line.
struct ReferenceColumn {
  std::string file;
  std::string x;
  std::string y;
  std::string label;
};

/// A results file that others are compared with, channel by channel.
struct ComparedRun {
  std::string file;
  std::string label;
};

struct SeriesRequest {
  std::vector<std::string> files;     ///< *.results.h5, also of interrupted runs
  std::vector<std::string> labels;    ///< of the files, in their order; fewer than files: the file names
  std::vector<std::string> channels;  ///< names, groups such as "nodes/position", or patterns with *
  std::vector<ReferenceColumn> references;
  std::vector<ComparedRun> reference_runs = {};
};

/// "file.csv:x column:y column[:label]"; the label may hold colons. Throws Error with the form.
ReferenceColumn parse_reference(const std::string& text);

/// "other.results.h5[:label]"; nothing: the text does not name a results file.
std::optional<ComparedRun> parse_reference_run(const std::string& text);

/// Reads two columns; a header cell "name [unit]" is found by "name" as well, any by its number from 1. Rows in which
/// either cell is empty or nan are left out. Throws Error with file:line:column, or with the names of the nearest
/// columns.
Series read_reference(const ReferenceColumn& column);

/// All series of a request: files in order, in each its channels, then the references: columns, and of reference runs the
/// channels that were chosen. A channel may be missing in some
/// of the files (a node has other names in other models), not in all of them, and no file may be without any. Throws
/// Error otherwise, or if nothing is asked for.
std::vector<Series> read_series(const SeriesRequest& request);

/// File name without folders and without ".results.h5", ".csv" and the like.
std::string stem(const std::string& path);

}  // namespace tisserand::mechanism
