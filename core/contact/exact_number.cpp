#include "core/contact/exact_number.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace tyglab {
namespace {

constexpr int limb_bits = 32;

using Limbs = std::vector<std::uint32_t>;

bool is_less(const Limbs& a, const Limbs& b) {
  assert(a.size() == b.size());
  return std::lexicographical_compare(a.rbegin(), a.rend(), b.rbegin(), b.rend());
}

/// a += b; a has a limb for the carry.
void add(Limbs& a, const Limbs& b) {
  std::uint64_t carry = 0;
  for (std::size_t n = 0; n < a.size(); ++n) {
    carry += std::uint64_t(a[n]) + (n < b.size() ? b[n] : 0);
    a[n] = std::uint32_t(carry);
    carry >>= limb_bits;
  }
  assert(carry == 0);
}

/// a -= b, where b is not greater.
void subtract(Limbs& a, const Limbs& b) {
  std::int64_t borrow = 0;
  for (std::size_t n = 0; n < a.size(); ++n) {
    borrow += std::int64_t(a[n]) - b[n];
    a[n] = std::uint32_t(borrow);
    borrow >>= limb_bits;
  }
  assert(borrow == 0);
}

}  // namespace

ExactNumber::ExactNumber(double value) : negative_(value < 0) {
  assert(std::isfinite(value));
  constexpr int digits = 53;
  int power = 0;
  const auto whole = std::uint64_t(std::ldexp(std::frexp(std::abs(value), &power), digits));
  power -= digits;
  const int shift = (power % limb_bits + limb_bits) % limb_bits;
  exponent_ = (power - shift) / limb_bits;
  const std::uint64_t low = (whole & 0xffffffffu) << shift;
  const std::uint64_t high = ((whole >> limb_bits) << shift) + (low >> limb_bits);
  limbs_ = {std::uint32_t(low), std::uint32_t(high), std::uint32_t(high >> limb_bits)};
  trim();
}

void ExactNumber::trim() {
  while (!limbs_.empty() && limbs_.back() == 0) limbs_.pop_back();
  const auto first = std::find_if(limbs_.begin(), limbs_.end(), [](std::uint32_t limb) { return limb != 0; });
  exponent_ += int(first - limbs_.begin());
  limbs_.erase(limbs_.begin(), first);
}

ExactNumber::Limbs ExactNumber::limbs_from(int exponent) const {
  assert(limbs_.empty() || exponent <= exponent_);
  Limbs limbs(limbs_.empty() ? 0 : std::size_t(exponent_ - exponent));
  limbs.insert(limbs.end(), limbs_.begin(), limbs_.end());
  return limbs;
}

ExactNumber operator+(const ExactNumber& a, const ExactNumber& b) {
  if (a.limbs_.empty()) return b;
  if (b.limbs_.empty()) return a;
  ExactNumber sum;
  sum.exponent_ = std::min(a.exponent_, b.exponent_);
  Limbs left = a.limbs_from(sum.exponent_), right = b.limbs_from(sum.exponent_);
  const std::size_t size = std::max(left.size(), right.size()) + 1;
  left.resize(size), right.resize(size);
  sum.negative_ = a.negative_;
  if (a.negative_ == b.negative_) {
    add(left, right);
  } else if (is_less(left, right)) {
    sum.negative_ = b.negative_;
    subtract(right, left), left.swap(right);
  } else {
    subtract(left, right);
  }
  sum.limbs_ = std::move(left);
  sum.trim();
  return sum;
}

ExactNumber operator-(const ExactNumber& a, const ExactNumber& b) {
  ExactNumber minus_b = b;
  minus_b.negative_ = !b.negative_;
  return a + minus_b;
}

ExactNumber operator*(const ExactNumber& a, const ExactNumber& b) {
  ExactNumber product;
  product.negative_ = a.negative_ != b.negative_;
  product.exponent_ = a.exponent_ + b.exponent_;
  product.limbs_.assign(a.limbs_.size() + b.limbs_.size(), 0);
  for (std::size_t n = 0; n < a.limbs_.size(); ++n) {
    std::uint64_t carry = 0;
    for (std::size_t m = 0; m < b.limbs_.size(); ++m) {
      carry += std::uint64_t(a.limbs_[n]) * b.limbs_[m] + product.limbs_[n + m];
      product.limbs_[n + m] = std::uint32_t(carry);
      carry >>= limb_bits;
    }
    product.limbs_[n + b.limbs_.size()] = std::uint32_t(carry);
  }
  product.trim();
  return product;
}

}  // namespace tyglab
