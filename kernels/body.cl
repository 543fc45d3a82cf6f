// A body as the kernels see it, before contact.cl.
#ifdef BODIES
#ifdef BODY_REAL_IS_DOUBLE
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#endif
#define BODY_REAL3 JOIN(BODY_REAL, 3)
#define VECTOR(x, y, z) ((BODY_REAL3)(x, y, z))

/// As BodyAt in core/forces/contact.h.
typedef struct {
  BODY_REAL c[3], axes[9], velocity[3], spin[3], size[3], extent, friction, restitution, reach;
  int shape, turns, spins, moves;
} Body;
#endif
