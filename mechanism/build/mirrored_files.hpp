// SPDX-License-Identifier: GPL-3.0-or-later
// Files as bodies use them: unchanged, or mirrored once for all bodies that need the same image.
#pragma once

#include <array>
#include <map>
#include <string>
#include <utility>

#include <Eigen/Core>

#include "formats/superelement/mirror.hpp"

namespace tisserand::mechanism {

/// Table of files and their mirror images. File: formats::LoadedSuperelement or formats::LoadedModalBody.
template <class File>
/// Table of files and their mirror images, in which each image is made once. `File`: formats::LoadedSuperelement or
/// formats::LoadedModalBody.
class MirroredFiles {
 public:
  /// Starts a table of `files` by path, without mirror images. Requires that `files` outlives this object.
  explicit MirroredFiles(const std::map<std::string, File>& files) : files_(files) {}

  /// File at `path`, mirrored by `axes`. `axes`: diagonal of the mirror, entries ±1 (formats/superelement/mirror.hpp);
  /// all 1: unchanged.
  const File& at(const std::string& path, const Eigen::Vector3d& axes) {
    const File& file = files_.at(path);
    if ((axes.array() > 0.0).all()) return file;
    const Image image{path, {axes.x(), axes.y(), axes.z()}};
    auto found = images_.find(image);
    if (found == images_.end()) found = images_.emplace(image, formats::mirrored(file, axes)).first;
    return found->second;
  }

 private:
  using Image = std::pair<std::string, std::array<double, 3>>;

  const std::map<std::string, File>& files_;
  std::map<Image, File> images_;
};

}  // namespace tisserand::mechanism
