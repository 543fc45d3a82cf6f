// A body as the kernels see it, before contact.cl.
#ifdef BODIES
#ifdef BODY_REAL_IS_DOUBLE
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#endif
#define BODY_REAL3 JOIN(BODY_REAL, 3)
#define VECTOR(x, y, z) ((BODY_REAL3)(x, y, z))

/// As DeviceBody in device_constants.h.
typedef struct {
  BODY_REAL c[3], r, y, friction, restitution;
  BODY_REAL touch;  // square of the distance from c (a plane: the height) under which a particle may touch it
  int plane, unused;
} Body;

INLINE BODY_REAL3 center(global const Body* body) { return (BODY_REAL3)(body->c[0], body->c[1], body->c[2]); }
INLINE int is_plane(global const Body* body) { return body->plane; }
#endif
