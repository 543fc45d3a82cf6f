#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/fields/spring_fields.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <functional>

#include "core/fields/particle_field.h"
#include "core/forces/spring-inl.h"
#include "core/simd/simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tyglab::HWY_NAMESPACE {
using namespace tyglab::simd::HWY_NAMESPACE;

/// F_s from its factor in F_s = factor · x_ij.
template <class R>
struct Tension {
  using D = hn::ScalableTag<R>;
  using L = Lanes<D>;
  Spring<L> many;
  Spring<double> one;
  explicit HWY_INLINE Tension(const FieldSprings<R>& s)
      : many(Spring<L>::of(s.k, s.rest, &L::all)), one(Spring<double>::of(s.k, s.rest, std::identity())) {}
  HWY_INLINE L operator()(L before, L r2) const {
    return hn::Max(before.v, hn::Mul(stretch_factor(many, r2).v, hn::Sqrt(r2.v)));
  }
  HWY_INLINE R operator()(R before, double r2) const {
    return std::max(before, R(stretch_factor(one, r2) * std::sqrt(r2)));
  }
};

template <class R>
struct Strain {
  using D = hn::ScalableTag<R>;
  using L = Lanes<D>;
  L part;
  double rest;
  explicit HWY_INLINE Strain(const FieldSprings<R>& s) : part(L::all(1 / s.rest)), rest(s.rest) {}
  HWY_INLINE L operator()(L before, L r2) const {
    return hn::Add(before.v, hn::MulSub(hn::Sqrt(r2.v), part.v, hn::Set(D(), R(1))));
  }
  HWY_INLINE R operator()(R before, double r2) const { return before + R((std::sqrt(r2) - rest) / rest); }
};

/// values[j] becomes what(values[j], |x_ij|²).
template <class What, class R>
HWY_INLINE void pass(const FieldSprings<R>& s, R* values) {
  using L = Lanes<hn::ScalableTag<R>>;
  const What what(s);
  const int lanes = int(hn::Lanes(hn::ScalableTag<R>()));
  int j = s.begin;
  for (; j + lanes <= s.end; j += lanes) {
    L r2;
    for (int c = 0; c < 3; ++c) {
      const L way = L::load(s.x[c] + j + s.other) - L::load(s.x[c] + j);
      r2 = multiply_add(way, way, r2);
    }
    hn::StoreU(what(L::load(values + j), r2).v, hn::ScalableTag<R>(), values + j);
  }
  for (; j < s.end; ++j) {  // nothing behind the row may be read
    double r2 = 0;
    for (int c = 0; c < 3; ++c) {
      const double way = double(s.x[c][j + s.other]) - double(s.x[c][j]);
      r2 += way * way;
    }
    values[j] = what(values[j], r2);
  }
}

void tension_float(const FieldSprings<float>& s, float* largest) {
  pass<Tension<float>>(s, largest);
}
void tension_double(const FieldSprings<double>& s, double* largest) {
  pass<Tension<double>>(s, largest);
}
void strain_float(const FieldSprings<float>& s, float* sum) {
  pass<Strain<float>>(s, sum);
}
void strain_double(const FieldSprings<double>& s, double* sum) {
  pass<Strain<double>>(s, sum);
}

}  // namespace tyglab::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tyglab {
namespace {

HWY_EXPORT(tension_float);
HWY_EXPORT(tension_double);
HWY_EXPORT(strain_float);
HWY_EXPORT(strain_double);

}  // namespace

void raise_to_tension(const FieldSprings<float>& springs, float* largest) {
  HWY_DYNAMIC_DISPATCH(tension_float)(springs, largest);
}
void raise_to_tension(const FieldSprings<double>& springs, double* largest) {
  HWY_DYNAMIC_DISPATCH(tension_double)(springs, largest);
}
void add_strain(const FieldSprings<float>& springs, float* sum) {
  HWY_DYNAMIC_DISPATCH(strain_float)(springs, sum);
}
void add_strain(const FieldSprings<double>& springs, double* sum) {
  HWY_DYNAMIC_DISPATCH(strain_double)(springs, sum);
}

}  // namespace tyglab
#endif
