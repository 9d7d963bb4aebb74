// The elementary functions, by + - * / and square roots alone: their results are the same bits on every processor,
// where those of the C library depend on its version and on whether the processor multiplies and adds at once. So a
// film is the same file wherever it is compiled. What a film or a model file has of them comes from here.
//
// Angles are in radians. All errors are below 1 unit in the last place (tests/host/content/elementary), for sin, cos
// and tan of angles up to 2^50, beyond which they are those of some angle; pow's is below 2 where the result is beyond
// 2^+-256. NaN gives NaN, but pow gives 1 where C does. Infinities are taken by atan, atan2, exp and exp2 alone; the
// other functions may give NaN. Zeros have C's signs from asin, atan, atan2 and cbrt alone.
#pragma once

namespace mars::elementary {

double sin(double angle);
double cos(double angle);
double tan(double angle);

// NaN where |x| > 1.
double asin(double x);
double acos(double x);

double atan(double x);
// The angle of the direction (x, y), -pi to pi, with C's signs of zeros.
double atan2(double y, double x);

double exp(double x);
double exp2(double x);
// NaN where x < 0, minus infinity at 0.
double log10(double x);
// A negative base gives NaN but for whole exponents.
double pow(double base, double exponent);
double cbrt(double x);

// Takes lengths from 1e-150 to 1e150.
double hypot(double x, double y);

}  // namespace mars::elementary
