// Writes the drawn data of a cloth into OpenGL's buffers: positions in float with their bounding box, and normals.
//
// Assumptions: `x` is a vector as in cloth.cl, in REAL. The output is row after row, with x, y and z of each row,
// `columns` numbers each. Work-items come in groups of 32 columns and 4 rows; a row may have fewer than its particles.
// Build options: -D REAL=float or -D REAL=double -D REAL_IS_DOUBLE.
#ifdef REAL_IS_DOUBLE
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#endif
#pragma OPENCL FP_CONTRACT OFF  // the bits that the host would compute

/// A word that is larger for a larger number.
static uint ordered(float a) {
  const uint bits = as_uint(a);
  return (bits >> 31) != 0 ? ~bits : bits | 0x80000000u;
}

/// Copies every n-th of the rows and columns of x, the last ones included. `box`: the least x, y and z so far, then the
/// greatest, as ordered() says, of those that are finite.
kernel void write_positions(global const REAL* x, int stride, global float* to, int rows, int columns, int every,
                            int last_row, int last_column, global uint* box) {
  local uint of_group[6];
  const int row = (int)get_global_id(1);
  const int first = get_local_id(0) == 0 && get_local_id(1) == 0;
  if (first)
    for (int c = 0; c < 3; ++c) of_group[c] = 0xffffffffu, of_group[3 + c] = 0;
  barrier(CLK_LOCAL_MEM_FENCE);
  if (row < rows)
    for (int c = 0; c < 3; ++c) {
      global const REAL* from = x + (min(row * every, last_row) + 2) * 3 * stride + 16 + c * stride;
      uint least = 0xffffffffu, most = 0;
      for (int column = (int)get_global_id(0); column < columns; column += (int)get_global_size(0)) {
        const float a = (float)from[min(column * every, last_column)];
        to[(row * 3 + c) * columns + column] = a;
        if (isfinite(a)) least = min(least, ordered(a)), most = max(most, ordered(a));
      }
      atomic_min(&of_group[c], least);
      atomic_max(&of_group[3 + c], most);
    }
  barrier(CLK_LOCAL_MEM_FENCE);
  if (!first) return;
  for (int c = 0; c < 3; ++c) atomic_min(box + c, of_group[c]), atomic_max(box + 3 + c, of_group[3 + c]);
}

static float3 at(global const float* x, int row, int column, int columns) {
  global const float* p = x + row * 3 * columns + column;
  return (float3)(p[0], p[columns], p[2 * columns]);
}
static void set(global float* n, int row, int column, int columns, float3 a) {
  global float* p = n + row * 3 * columns + column;
  p[0] = a.x, p[columns] = a.y, p[2 * columns] = a.z;
}
static float3 crossed(float3 a, float3 b) {
  return (float3)(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

/// Normals as compute_normals() has them (app/render/cloth_mesh.h): down × along.
kernel void write_normals(global const float* x, global float* n, int rows, int columns) {
  const int i = (int)get_global_id(1);
  if (i >= rows) return;
  for (int j = (int)get_global_id(0); j < columns; j += (int)get_global_size(0)) {
    const float3 down = at(x, min(i + 1, rows - 1), j, columns) - at(x, max(i - 1, 0), j, columns);
    const float3 along = at(x, i, min(j + 1, columns - 1), columns) - at(x, i, max(j - 1, 0), columns);
    set(n, i, j, columns, crossed(down, along));
  }
}

/// quad_triangles of lattice.h: rows and columns from the quad's upper left corner, [odd][which][corner].
constant char2 corners[2][2][3] = {{{(char2)(0, 0), (char2)(1, 0), (char2)(1, 1)}, {(char2)(0, 0), (char2)(1, 1), (char2)(0, 1)}},
                                   {{(char2)(0, 0), (char2)(1, 0), (char2)(0, 1)}, {(char2)(1, 0), (char2)(1, 1), (char2)(0, 1)}}};

/// The normals at particles beside tears: the sum over their whole triangles, (0, 0, 1) without one. A work-item a
/// particle of `torn`, which holds its site and its triangles (TornSite).
kernel void write_torn_normals(global const float* x, global float* n, int columns, global const uint2* torn, int count) {
  const int k = (int)get_global_id(0);
  if (k >= count) return;
  const int i = (int)torn[k].x / columns, j = (int)torn[k].x % columns;
  float3 sum = (float3)(0, 0, 0);
  for (int t = 0; t < 8; ++t) {
    if ((torn[k].y >> t & 1) == 0) continue;
    const int row = i - 1 + (t >> 2), column = j - 1 + (t >> 1 & 1);
    float3 p[3];
    for (int c = 0; c < 3; ++c) {
      const char2 corner = corners[(row + column) & 1][t & 1][c];
      p[c] = at(x, row + corner.x, column + corner.y, columns);
    }
    sum += crossed(p[1] - p[0], p[2] - p[0]);
  }
  const float square = sum.x * sum.x + sum.y * sum.y + sum.z * sum.z;
  set(n, i, j, columns, square > 0 ? sum : (float3)(0, 0, 1));
}
