// Connections between particles in a view: lists of vertex indices, where particle (i, j) is vertex i·stride + j.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "app/render/vertex_normals.h"
#include "core/cloth/lattice.h"
#include "core/cloth/tears.h"

namespace tyglab {

using Indices = std::vector<std::uint32_t>;

/// Three indices for each whole triangle, counter-clockwise seen from the front.
Indices triangle_indices(const Lattice& lattice, int stride, const Tears& tears);
/// Two indices for each whole spring of the directions `first` to `last` (lattice.h), `last` not included.
Indices spring_indices(const Lattice& lattice, int stride, const Tears& tears, int first, int last);
/// Two indices for each edge of a whole triangle, each edge once.
Indices outline_indices(const Lattice& lattice, int stride, const Tears& tears);
/// Two indices for each whole stretch spring in a quad that has lost a triangle.
Indices connection_indices(const Lattice& lattice, int stride, const Tears& tears);
/// What closes the edges of a torn cloth, four indices a piece. A quad that has lost triangles shows one of its other
/// diagonal, if that is whole and its counterpart is not: a, b, c, a, counter-clockwise seen from the front. Beyond
/// each edge (a, b) of what is shown, threads end where a triangle is missing: c is the corner on this side, d the one
/// beyond.
Indices frayed_indices(const Lattice& lattice, int stride, const Tears& tears);
/// An index for each particle for which `wanted` holds.
Indices particle_indices(const Lattice& lattice, int stride, const std::function<bool(int, int)>& wanted);
/// Takes out what has an edge longer than `longest` m or not finite; `corners` indices stand for each triangle or line.
void remove_long(Indices& indices, int corners, const FloatRows& positions, float longest);
/// Particles, each once, that are a corner of a triangle that is not whole.
std::vector<std::uint32_t> particles_beside_tears(const Lattice& lattice, int stride, const Tears& tears);

}  // namespace tyglab
