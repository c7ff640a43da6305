#include "antigrasp/python/contact_arrays.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "antigrasp/core/error.h"

namespace antigrasp::python {
namespace {

using Eigen::Vector3d;

constexpr std::int64_t kRowsAtATime = 1024;

Vector3d At(const double* rows, std::int64_t row, int contact) {
  return Eigen::Map<const Vector3d>(rows + 6 * row + 3 * contact);
}

Vector3d ComOf(const ContactArrays& contacts, std::int64_t row) {
  return Eigen::Map<const Vector3d>(contacts.coms + (contacts.com_each ? 3 * row : 0));
}

void RequireDirection(const Vector3d& v, const char* name, std::int64_t row) {
  if (v.allFinite() && v.stableNorm() > 0.0) return;
  throw InputError(std::string(name) + "[" + std::to_string(row) + "]", "epsilon",
                   "finite directions that are not zero");
}

void RequireFinite(bool finite, const char* name, std::int64_t row) {
  if (finite) return;
  throw InputError(std::string(name) + "[" + std::to_string(row) + "]", "epsilon",
                   "finite numbers");
}

double EpsilonOfRow(const ContactArrays& contacts, std::int64_t row) {
  WrenchModel model = contacts.model;
  if (contacts.frictions != nullptr) model.friction = contacts.frictions[row];
  std::array<Contact, 2> both;
  for (int i = 0; i < 2; ++i) {
    Contact& contact = both[static_cast<std::size_t>(i)];
    contact.point = At(contacts.points, row, i);
    contact.normal = At(contacts.normals, row, i).stableNormalized();
    if (contacts.closings == nullptr) continue;
    const Vector3d inward = -contact.normal;
    const Vector3d closing = At(contacts.closings, row, i).stableNormalized();
    contact.normal_force =
        Slips(inward, closing, model.friction) ? 0.0 : std::max(closing.dot(inward), 0.0);
  }
  return Epsilon(both, ComOf(contacts, row), model);
}

}  // namespace

void RequireContacts(const ContactArrays& contacts) {
  for (std::int64_t row = 0; row < contacts.count; ++row) {
    for (int i = 0; i < 2; ++i) {
      RequireFinite(At(contacts.points, row, i).allFinite(), "points", row);
      RequireDirection(At(contacts.normals, row, i), "normals", row);
      if (contacts.closings != nullptr) {
        RequireDirection(At(contacts.closings, row, i), "closing", row);
      }
    }
    if (contacts.com_each || row == 0) RequireFinite(ComOf(contacts, row).allFinite(), "com", row);
    if (contacts.frictions == nullptr) continue;
    if (contacts.frictions[row] >= 0.0 && contacts.frictions[row] <= 10.0) continue;
    throw InputError("friction[" + std::to_string(row) + "]", "epsilon", "numbers in [0, 10]");
  }
}

void EpsilonOfAll(const ContactArrays& contacts, int threads, std::span<double> epsilons,
                  const ProgressFn& progress) {
  ParallelFor((contacts.count + kRowsAtATime - 1) / kRowsAtATime, threads,
              [&](std::int64_t block) {
                const std::int64_t end = std::min(contacts.count, (block + 1) * kRowsAtATime);
                for (std::int64_t row = block * kRowsAtATime; row < end; ++row) {
                  epsilons[static_cast<std::size_t>(row)] = EpsilonOfRow(contacts, row);
                }
              },
              progress);
}

}  // namespace antigrasp::python
