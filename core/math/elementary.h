// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

// Elementary functions with the same bits on every processor. The C library's choose among variants
// with and without fused multiply-add (FMA), which differ in the last bit. These compute with the
// 64-bit significands of `long double` and round once to double: errors below 0.51 units in the
// last place (erfc: 0.7). They use nothing but IEEE additions, multiplications, divisions and
// square roots. Methods: argument reduction with tables (P. T. P. Tang, ACM TOMS 15 and 16, 1989
// and 1990), of sine and cosine after Cody and Waite, and Payne and Hanek (J.-M. Muller, Elementary
// Functions, 2016, ch. 11).
//
// Special values are those of C's Annex F. errno is not set.

namespace vinebench::elementary {

struct SineCosine {
  double sine;
  double cosine;
};

double exp(double x);
double expm1(double x);
double sinh(double x);
double cosh(double x);
double tanh(double x);
/// Of float arguments, 2^x.
double exp2_of_float(float x);

double log(double x);
double log2(double x);
double log10(double x);
double log1p(double x);
double pow(double x, double y);

double sin(double x);
double cos(double x);
double tan(double x);
SineCosine sincos(double x);

double asin(double x);
double acos(double x);
double atan(double x);
double atan2(double y, double x);

double erfc(double x);

}  // namespace vinebench::elementary
