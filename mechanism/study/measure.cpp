// SPDX-License-Identifier: GPL-3.0-or-later
// Norms of histories and of their differences.
#include "mechanism/study/measure.hpp"

#include <algorithm>
#include <cmath>

#include "common/error.hpp"
#include "common/text.hpp"
#include "mechanism/histories/difference.hpp"

namespace tisserand::mechanism {
namespace {

using formats::ErrorNorm;

struct Peak {
  double value = 0.0;
  double time = 0.0;
};

/// Part of a history from `from` to `to`.
Series clipped(const Series& series, const formats::StudyQuantity& quantity) {
  Series part = series;
  part.x.clear();
  part.y.clear();
  for (std::size_t i = 0; i < series.x.size(); ++i)
    if ((!quantity.from || series.x[i] >= *quantity.from) && (!quantity.to || series.x[i] <= *quantity.to)) {
      part.x.push_back(series.x[i]);
      part.y.push_back(series.y[i]);
    }
  if (part.x.empty())
    throw Error(fmt::format("quantity '{}': channel '{}' has no instant between 'from' and 'to'", quantity.name,
                            series.channel),
                series.source, "widen 'from' and 'to', or store more instants");
  for (const double y : part.y)
    if (!std::isfinite(y))
      throw Error(fmt::format("quantity '{}': channel '{}' contains a value that is not a number", quantity.name,
                              series.channel),
                  series.source, "choose another channel");
  return part;
}

/// Largest absolute value; inside the history the vertex of the parabola through it and its neighbours.
Peak peak_of(const Series& series) {
  std::size_t k = 0;
  for (std::size_t i = 1; i < series.y.size(); ++i)
    if (std::abs(series.y[i]) > std::abs(series.y[k])) k = i;
  Peak peak{std::abs(series.y[k]), series.x[k]};
  if (k == 0 || k + 1 == series.y.size()) return peak;
  const double left = series.x[k - 1] - series.x[k], right = series.x[k + 1] - series.x[k];
  if (!(left < 0.0 && right > 0.0)) return peak;
  // y = y_k + a s + b s² through the neighbours.
  const double y_left = std::abs(series.y[k - 1]) - peak.value, y_right = std::abs(series.y[k + 1]) - peak.value;
  const double b = (y_right / right - y_left / left) / (right - left), a = y_left / left - b * left;
  if (!(b < 0.0)) return peak;
  const double s = -0.5 * a / b;
  return {peak.value + s * (a + b * s), peak.time + s};
}

}  // namespace

std::vector<Series> read_quantities(const std::string& results, const std::vector<std::string>& channels) {
  std::vector<Series> histories;
  for (const std::string& channel : channels) {
    SeriesRequest request;
    request.files = {results};
    request.channels = {channel};
    std::vector<Series> found = read_series(request);
    if (found.size() != 1)
      throw Error(fmt::format("'{}' matches {} channels", channel, found.size()), results, "name exactly one");
    histories.push_back(std::move(found.front()));
  }
  return histories;
}

std::vector<Series> read_reference_file(const formats::Study& study) {
  const formats::StudyReference& reference = study.reference;
  std::vector<Series> histories;
  for (const formats::StudyQuantity& quantity : study.quantities) {
    const auto column = reference.columns.find(quantity.name);
    const bool is_results = reference.file.ends_with(".h5");
    const std::string name = column != reference.columns.end() ? column->second
                             : is_results                      ? quantity.channel.text
                                                               : quantity.name;
    histories.push_back(is_results ? read_quantities(reference.file, {name}).front()
                                   : read_reference({reference.file, reference.time, name, ""}));
  }
  return histories;
}

double size_of(const Series& series, const formats::StudyQuantity& quantity) {
  const Series part = clipped(series, quantity);
  switch (quantity.norm) {
    case ErrorNorm::rms:
      return deviation(part, part, {}).reference_rms;
    case ErrorNorm::peak_time:
      return peak_of(part).time;
    case ErrorNorm::max:
    case ErrorNorm::final:
    case ErrorNorm::peak:
      return peak_of(part).value;
  }
  return 0.0;
}

double error_of(const Series& series, const Series& reference, const formats::StudyQuantity& quantity) {
  const Series measured = clipped(series, quantity), expected = clipped(reference, quantity);
  const double scale = quantity.scale                          ? *quantity.scale
                       : quantity.norm == ErrorNorm::peak_time ? 1.0
                                                               : size_of(reference, quantity);
  if (!(scale > 0.0))
    throw Error(fmt::format("quantity '{}': the reference is zero, so a relative error is not defined", quantity.name),
                reference.source, "give the quantity a 'scale'");
  const TimeWindow window{quantity.from, quantity.to};
  switch (quantity.norm) {
    case ErrorNorm::max:
      return deviation(series, reference, window).largest / scale;
    case ErrorNorm::rms:
      return deviation(series, reference, window).rms / scale;
    case ErrorNorm::final: {
      const double end = std::min(measured.x.back(), expected.x.back());
      return std::abs(value_at(series, end) - value_at(reference, end)) / scale;
    }
    case ErrorNorm::peak:
      return std::abs(peak_of(measured).value - peak_of(expected).value) / scale;
    case ErrorNorm::peak_time:
      return std::abs(peak_of(measured).time - peak_of(expected).time) / scale;
  }
  return 0.0;
}

}  // namespace tisserand::mechanism
