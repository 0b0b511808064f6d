// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/search/minimise.h"

#include <nlopt.h>

#include <exception>
#include <memory>
#include <type_traits>

#include "core/util/error.h"

namespace vinebench::harness {
namespace {

using Optimiser = std::unique_ptr<std::remove_pointer_t<nlopt_opt>, decltype(&nlopt_destroy)>;

/// Nothing may be thrown through the library's own functions.
struct Call {
  const std::function<double(const std::vector<double>&)>& function;
  nlopt_opt optimiser;
  std::exception_ptr error;
};

double value_at(unsigned size, const double* at, double*, void* data) {
  Call& call = *static_cast<Call*>(data);
  try {
    return call.function(std::vector<double>(at, at + size));
  } catch (...) {
    call.error = std::current_exception();
    nlopt_force_stop(call.optimiser);
    return 0;
  }
}

}  // namespace

void minimise(const std::function<double(const std::vector<double>&)>& function,
              const std::vector<double>& upper, int evaluations) {
  const auto size = static_cast<unsigned>(upper.size());
  const Optimiser optimiser(nlopt_create(NLOPT_GN_DIRECT_L, size), nlopt_destroy);
  if (!optimiser) fail("the optimiser cannot be made: out of memory");
  Call call{function, optimiser.get(), nullptr};
  std::vector<double> at(upper.size());
  double least = 0;
  nlopt_set_min_objective(optimiser.get(), value_at, &call);
  nlopt_set_lower_bounds1(optimiser.get(), 0);
  nlopt_set_upper_bounds(optimiser.get(), upper.data());
  nlopt_set_maxeval(optimiser.get(), evaluations);
  const nlopt_result result = nlopt_optimize(optimiser.get(), at.data(), &least);
  if (call.error) std::rethrow_exception(call.error);
  if (result < 0) fail("NLopt: {}", nlopt_result_to_string(result));
}

}  // namespace vinebench::harness
