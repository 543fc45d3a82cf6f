// Arguments of kernels and contents of buffers, with the structs of kernels/cloth.cl, bodies.cl and implicit.cl.
#pragma once

#include <cstdint>

namespace tyglab::opencl {

inline constexpr int most_coefficients = 16;  ///< in the sums of one sweep

/// Constants of cloth.cl.
template <class R>
struct DeviceConstants {
  R weft = 0, weft_half = 0, warp = 0, warp_half = 0, shear = 0, shear_half = 0;
  R bend = 0, bending = 0, shortest2 = 0;
  R k_d = 0;
  R weight = 0;
  R wind[3] = {};
  R air[3] = {}, air_across = 0, air_along = 0, air_most = 0;
  R smallest = 0;
  R dt = 0, to_way = 0, to_velocity = 0;
  R k = 0, middle = 0;
  R c[most_coefficients] = {};
};

/// ContactRule of contact.cl; B is double where the device has it.
template <class B>
struct DeviceContactRule {
  B dt, epsilon, g, share, kick, lag;
  std::int32_t at_ends, upright;
};

/// Contact of bodies.cl.
template <class B>
struct DeviceContact {
  B x[3], v[3];
  std::int32_t particle, unused;
};

/// Linear of implicit.cl.
template <class R>
struct DeviceLinear {
  R weft = 0, warp = 0, shear = 0, bend = 0, k_d = 0;
  R own = 1;
  R straight = 0, diagonal = 0, bending = 0;
  R shortest = 0;
  R linear = 0;
};

/// Share of tears.cl.
template <class R>
struct DeviceShare {
  R constant = 0;
  std::int32_t direction = 0, di = 0, dj = 0;
  std::int32_t last_row = 0, first_column = 0, last_column = 0, springs = 0;
  std::int32_t bit[6] = {}, spring_di[6] = {}, spring_dj[6] = {};
};

/// Gradients of implicit.cl.
template <class B>
struct DeviceGradients {
  B squared, preconditioned, curvature, enough, before;
  std::int32_t count, unused;
};

/// StepMeasures of a step, as the device reports them.
struct DeviceStepMeasures {
  float way;  ///< largest component of a displacement, m; ∞ or NaN if something is not finite
  std::uint32_t left_inside, contacts;
  std::uint32_t torn;        ///< 1: a spring was torn
  float straight, diagonal;  ///< squares of the lengths of the longest springs left whole, m²; where springs are torn,
                             ///< `straight` is of those along the rows alone,
  float bending;             ///< and this of those down the columns
  std::uint32_t bad;         ///< 1: a number of the state is not finite
};

}  // namespace tyglab::opencl
