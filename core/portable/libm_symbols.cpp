// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0

// Definitions of the C library's elementary functions for programs: the loader resolves shared
// libraries' references (MuJoCo's, OpenCV's, AprilTag's) to those of the program first. They are
// all that glibc 2.36 chooses by the processor, and those that call one of these. Only programs
// define them, never a library: it would change the arithmetic of a foreign process. The Python
// module has them for itself and the libraries loaded with it (python/vinebench/_load.py).
#include "core/math/elementary.h"

namespace elementary = vinebench::elementary;

extern "C" {

#define VINEBENCH_ONE_ARGUMENT(name) \
  double name(double x) noexcept;    \
  double name(double x) noexcept {   \
    return elementary::name(x);      \
  }
#define VINEBENCH_ONE_FLOAT(name)                   \
  float name##f(float x) noexcept;                  \
  float name##f(float x) noexcept {                 \
    return static_cast<float>(elementary::name(x)); \
  }

VINEBENCH_ONE_ARGUMENT(exp)
VINEBENCH_ONE_ARGUMENT(expm1)
VINEBENCH_ONE_ARGUMENT(sinh)
VINEBENCH_ONE_ARGUMENT(cosh)
VINEBENCH_ONE_ARGUMENT(tanh)
VINEBENCH_ONE_ARGUMENT(log)
VINEBENCH_ONE_ARGUMENT(log2)
VINEBENCH_ONE_ARGUMENT(log10)
VINEBENCH_ONE_ARGUMENT(log1p)
VINEBENCH_ONE_ARGUMENT(sin)
VINEBENCH_ONE_ARGUMENT(cos)
VINEBENCH_ONE_ARGUMENT(tan)
VINEBENCH_ONE_ARGUMENT(asin)
VINEBENCH_ONE_ARGUMENT(acos)
VINEBENCH_ONE_ARGUMENT(atan)
VINEBENCH_ONE_ARGUMENT(erfc)

VINEBENCH_ONE_FLOAT(exp)
VINEBENCH_ONE_FLOAT(log)
VINEBENCH_ONE_FLOAT(log2)
VINEBENCH_ONE_FLOAT(log10)
VINEBENCH_ONE_FLOAT(sin)
VINEBENCH_ONE_FLOAT(cos)
VINEBENCH_ONE_FLOAT(tan)
VINEBENCH_ONE_FLOAT(asin)
VINEBENCH_ONE_FLOAT(acos)
VINEBENCH_ONE_FLOAT(atan)

double pow(double x, double y) noexcept;
double pow(double x, double y) noexcept {
  return elementary::pow(x, y);
}

float powf(float x, float y) noexcept;
float powf(float x, float y) noexcept {
  return static_cast<float>(elementary::pow(x, y));
}

double atan2(double y, double x) noexcept;
double atan2(double y, double x) noexcept {
  return elementary::atan2(y, x);
}

float atan2f(float y, float x) noexcept;
float atan2f(float y, float x) noexcept {
  return static_cast<float>(elementary::atan2(y, x));
}

float exp2f(float x) noexcept;
float exp2f(float x) noexcept {
  return static_cast<float>(elementary::exp2_of_float(x));
}

void sincos(double x, double* sine, double* cosine) noexcept;
void sincos(double x, double* sine, double* cosine) noexcept {
  const elementary::SineCosine both = elementary::sincos(x);
  *sine = both.sine;
  *cosine = both.cosine;
}

void sincosf(float x, float* sine, float* cosine) noexcept;
void sincosf(float x, float* sine, float* cosine) noexcept {
  const elementary::SineCosine both = elementary::sincos(x);
  *sine = static_cast<float>(both.sine);
  *cosine = static_cast<float>(both.cosine);
}

}  // extern "C"
