#include "antigrasp/sdf/orient2d.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace antigrasp {
namespace {

int Sign(double v) { return (v > 0.0) - (v < 0.0); }

// A sum of doubles kept without rounding, smallest part first (Shewchuk's grow-expansion).
class ExactSum {
 public:
  void AddProduct(double a, double b) {
    const double product = a * b;
    Add(std::fma(a, b, -product));
    Add(product);
  }
  int SignOfSum() const {
    for (std::size_t i = size_; i-- > 0;) {
      if (parts_[i] != 0.0) return Sign(parts_[i]);
    }
    return 0;
  }

 private:
  void Add(double value) {
    double carry = value;
    for (std::size_t i = 0; i < size_; ++i) {
      const double sum = carry + parts_[i];
      const double virtual_part = sum - carry;
      parts_[i] = (carry - (sum - virtual_part)) + (parts_[i] - virtual_part);
      carry = sum;
    }
    parts_[size_++] = carry;
  }

  std::array<double, 12> parts_{};
  std::size_t size_ = 0;
};

int ExactOrient2dSign(const Point2& a, const Point2& b, const Point2& c) {
  ExactSum sum;
  sum.AddProduct(a.x, b.y);
  sum.AddProduct(-a.y, b.x);
  sum.AddProduct(b.x, c.y);
  sum.AddProduct(-b.y, c.x);
  sum.AddProduct(c.x, a.y);
  sum.AddProduct(-c.y, a.x);
  return sum.SignOfSum();
}

}  // namespace

int Orient2dSign(const Point2& a, const Point2& b, const Point2& c) {
  const double left = (a.x - c.x) * (b.y - c.y);
  const double right = (a.y - c.y) * (b.x - c.x);
  const double det = left - right;
  constexpr double kErrorBound = 3.3306690738754716e-16;  // (3 + 16 u) u, u = 2^-53
  if (std::abs(det) > kErrorBound * (std::abs(left) + std::abs(right))) return Sign(det);
  return ExactOrient2dSign(a, b, c);
}

int Orient2dSignPerturbed(const Point2& a, const Point2& b, const Point2& c) {
  const int sign = Orient2dSign(a, b, c);
  if (sign != 0) return sign;
  // The determinant moves by (b.x - a.x) epsilon^2 - (b.y - a.y) epsilon.
  if (b.y != a.y) return Sign(a.y - b.y);
  return Sign(b.x - a.x);
}

}  // namespace antigrasp
