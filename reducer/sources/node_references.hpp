// SPDX-License-Identifier: GPL-3.0-or-later
// All references of a mesh to nodes.
#pragma once

#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// Calls visit(int&) for every reference of the mesh to a node.
template <class Visit>
void for_nodes(Mesh& mesh, Visit visit) {
  for (BeamElement& e : mesh.beams) visit(e.first), visit(e.second);
  for (ShellElement& e : mesh.shells)
    for (int k = 0; k < e.corners(); ++k) visit(e.nodes[k]);
  for (SolidElement& e : mesh.solids)
    for (int k = 0; k < node_count(e.shape); ++k) visit(e.nodes[k]);
  for (Spring& e : mesh.springs) visit(e.first), visit(e.second);
  for (NodalMass& e : mesh.masses) visit(e.node);
  for (Spider& e : mesh.spiders) {
    visit(e.reference);
    for (int& node : e.nodes) visit(node);
  }
  for (TieEquation& e : mesh.equations)
    for (TieTerm& term : e.terms) visit(term.node);
  for (MeshBoundary& e : mesh.boundary) visit(e.node);
  for (FrameNode& e : mesh.held) visit(e.node);
  for (MeshSupport& e : mesh.supports)
    for (int& node : e.nodes) visit(node);
  for (MeshLoadCase& e : mesh.load_cases) {
    for (NodeLoad& load : e.forces) visit(load.node);
    for (FacePressure& load : e.faces)
      for (int k = 0; k < load.count; ++k) visit(load.nodes[k]);
    for (EdgeLineLoad& load : e.edges)
      for (int k = 0; k < load.count; ++k) visit(load.nodes[k]);
  }
}

}  // namespace tisserand::reducer
