// Files as bodies are made from them: as they were read, or mirrored, once for all bodies that want the same image.
#pragma once

#include <array>
#include <map>
#include <string>
#include <utility>

#include <Eigen/Core>

#include "formats/superelement/mirror.hpp"

namespace tisserand::mechanism {

/// File: formats::LoadedSuperelement or formats::LoadedModalBody.
template <class File>
class MirroredFiles {
 public:
  /// `files` by path, which outlive this.
  explicit MirroredFiles(const std::map<std::string, File>& files) : files_(files) {}

  /// `axes`: diagonal of the mirror (formats/superelement/mirror.hpp).
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
