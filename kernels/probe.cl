// The test of `tyglab devices`: the length of the vector from each particle to the next, which every spring needs.
//
// Assumptions: x has all x, then all y, then all z of `count` particles; `lengths` has room for count - 1 numbers; one
// work-item per particle, any number of them, and those from count - 1 on do nothing. Build options: -D REAL=float (the
// default) or -D REAL=double -D REAL_IS_DOUBLE, which requires cl_khr_fp64.
#ifndef REAL
#define REAL float
#endif
#ifdef REAL_IS_DOUBLE
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#endif

kernel void probe(global const REAL* x, global REAL* lengths, int count) {
  const int p = (int)get_global_id(0);
  if (p >= count - 1) return;
  const REAL dx = x[p + 1] - x[p];
  const REAL dy = x[count + p + 1] - x[count + p];
  const REAL dz = x[2 * count + p + 1] - x[2 * count + p];
  lengths[p] = sqrt(dx * dx + dy * dy + dz * dz);
}
