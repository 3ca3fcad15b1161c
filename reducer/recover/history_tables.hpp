// SPDX-License-Identifier: GPL-3.0-or-later
// Tables of histories of nodes, elements and groups.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "reducer/recover/histories.hpp"
#include "reducer/recover/measures.hpp"

namespace tisserand::reducer {

/// Node, element or group that the user chose, with the words that chose it.
struct ChosenItem {
  std::string label;
  int index = 0;  ///< index of the node, element or group in the recovery file
};

/// Values of chosen items of one field at the instants of a batch, collected from the blocks of the field.
class KeptItems {
 public:
  explicit KeptItems(formats::RecoveryField field) : field_(field) {}
  void want(int item) { rows_.try_emplace(item); }
  void take(const FieldBlock& block);
  /// Values of one item (width of the field x instants).
  const Eigen::MatrixXf& of(int item) const { return rows_.at(item); }

 private:
  formats::RecoveryField field_;
  std::map<int, Eigen::MatrixXf> rows_;
};

/// Table of chosen nodes: displacement x, y, z (axes of the requested frame), position, and largest von Mises stress
/// of the elements at the node (beams: |normal stress|).
class NodeTable : public HistoryTable {
 public:
  NodeTable(const formats::Recovery& recovery, const BodyMotion& still, RecoverFrame frame,
            std::vector<ChosenItem> nodes);
  std::string header() const override;
  void take(const FieldBlock& block) override;
  std::string cells(const BodyMotion& motion, Eigen::Index instant) const override;

 private:
  struct Around {
    std::vector<int> beams, shells, points;
  };
  float stress_at(const Around& around, const BodyMotion& motion, Eigen::Index instant) const;

  const formats::Recovery& recovery_;
  const BodyMotion& still_;
  RecoverFrame frame_;
  std::vector<ChosenItem> nodes_;
  std::vector<Around> around_;
  KeptItems translation_{formats::RecoveryField::translation}, beam_{formats::RecoveryField::beam_force},
      shell_{formats::RecoveryField::shell_stress}, solid_{formats::RecoveryField::solid_stress};
};

/// Table of chosen elements. Beams have forces and moments at both ends, and the largest and smallest normal stress.
/// Shells have the von Mises stress of both faces, principal stresses, and membrane and bending stress. Solids have
/// von Mises and principal stresses of their worst node, and the mean stress of their nodes.
class StressTable : public HistoryTable {
 public:
  StressTable(const formats::Recovery& recovery, const BodyMotion& still, std::vector<ChosenItem> elements);
  std::string header() const override;
  void take(const FieldBlock& block) override;
  std::string cells(const BodyMotion& motion, Eigen::Index instant) const override;

 private:
  std::string beam_cells(int beam, const BodyMotion& motion, Eigen::Index instant) const;
  std::string shell_cells(int shell, Eigen::Index instant) const;
  std::string solid_cells(int element, Eigen::Index instant) const;

  const formats::Recovery& recovery_;
  const BodyMotion& still_;
  std::vector<ChosenItem> elements_;
  std::map<int, std::vector<int>> points_;  ///< stress points of each solid
  KeptItems beam_{formats::RecoveryField::beam_force}, shell_{formats::RecoveryField::shell_stress},
      solid_{formats::RecoveryField::solid_stress};
};

/// Table of chosen groups: largest von Mises stress with its element (for solids, the label of its node), and largest
/// and smallest principal stress.
class GroupTable : public HistoryTable {
 public:
  GroupTable(const formats::Recovery& recovery, const BodyMotion& still, std::vector<ChosenItem> groups);
  std::string header() const override;
  void begin(Eigen::Index instants) override;
  void take(const FieldBlock& block) override;
  std::string cells(const BodyMotion& motion, Eigen::Index instant) const override;

 private:
  struct Worst {
    float von_mises = 0.0f, largest = 0.0f, smallest = 0.0f;
    int at = -1;  ///< element, or stress point of a solid
    bool is_point = false;
  };
  void raise(int group, const FieldBlock& block, Eigen::Index i);

  const formats::Recovery& recovery_;
  const BodyMotion& still_;
  std::vector<ChosenItem> groups_;
  std::vector<int> row_;                   ///< row of each group of the recovery file in `groups_`; −1: not chosen
  std::vector<std::vector<Worst>> worst_;  ///< first index: row, second: instant of the batch
};

}  // namespace tisserand::reducer
