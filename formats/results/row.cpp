// SPDX-License-Identifier: GPL-3.0-or-later
// Sizes of the values of one instant, in memory and in the file.
#include <algorithm>

#include "formats/results/blocks.hpp"

namespace tisserand::formats {

void ResultsRow::resize(const ResultsLayout& layout) {
  const auto is_reaction = [](const Block& block) {
    return block.dataset == "/joints/force" || block.dataset == "/joints/moment" || block.dataset == "/motions/force" ||
           block.dataset == "/couplings/first_force" || block.dataset == "/couplings/second_force";
  };
  reactions = std::ranges::any_of(chosen_blocks(layout, layout.scene), is_reaction);
  for (const Block& block : all_blocks(layout))
    block.resize(*this, block.shape.empty() ? 1 : static_cast<Eigen::Index>(block.shape[0]));
  const auto tyres = static_cast<Eigen::Index>(layout.tyres.size());
  for (Eigen::Matrix2Xd* block : {&tyre_deflection, &tyre_deflection_rate}) block->setZero(2, tyres);  // stored or not
  for (Eigen::Matrix4Xd* rotation : {&node_rotation, &frame_rotation}) rotation->row(0).setOnes();
}

std::size_t bytes_of_row(const ResultsLayout& layout) {
  std::size_t width = 0;
  for (const Block& block : chosen_blocks(layout, layout.scene)) width += block.width();
  return width * sizeof(double);
}

}  // namespace tisserand::formats
