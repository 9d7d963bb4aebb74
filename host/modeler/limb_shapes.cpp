#include "host/modeler/limb_shapes.h"

#include "host/modeler/loft.h"

namespace mars::host {
namespace {

// Rings as in body_shapes.cpp: at, front, back, width, middle. The joint is at 0, the next one at -1; a hand
// is half as long.
// clang-format off

constexpr Ring kUpperLimb[] = {
    {-1.100, 0.040, 0.040, 0.040},
    {-1.090, 0.075, 0.075, 0.075},
    {-1.045, 0.105, 0.105, 0.105},
    {-0.960, 0.117, 0.117, 0.117},
    {-0.800, 0.124, 0.124, 0.122},
    {-0.600, 0.140, 0.138, 0.134},
    {-0.400, 0.154, 0.150, 0.146},
    {-0.220, 0.160, 0.156, 0.152},
    {-0.060, 0.155, 0.153, 0.150},
    { 0.060, 0.135, 0.133, 0.131},
    { 0.130, 0.095, 0.095, 0.093},
    { 0.145, 0.050, 0.050, 0.050},
};

constexpr Ring kLowerLimb[] = {
    {-1.075, 0.026, 0.026, 0.026},
    {-1.068, 0.052, 0.052, 0.052},
    {-1.035, 0.074, 0.074, 0.074},
    {-0.970, 0.083, 0.083, 0.083},
    {-0.820, 0.086, 0.088, 0.085},
    {-0.640, 0.094, 0.105, 0.094},
    {-0.460, 0.104, 0.130, 0.107},
    {-0.300, 0.111, 0.142, 0.115},
    {-0.160, 0.115, 0.133, 0.117},
    {-0.020, 0.114, 0.117, 0.115},
    { 0.060, 0.096, 0.096, 0.096},
    { 0.100, 0.068, 0.068, 0.068},
    { 0.110, 0.034, 0.034, 0.034},
};

constexpr Ring kMitten[] = {
    {-0.500, 0.045, 0.045, 0.020},
    {-0.492, 0.085, 0.085, 0.040},
    {-0.450, 0.118, 0.118, 0.055},
    {-0.360, 0.136, 0.134, 0.064},
    {-0.240, 0.142, 0.136, 0.070},
    {-0.120, 0.120, 0.116, 0.074},
    {-0.020, 0.088, 0.088, 0.076},
    { 0.050, 0.072, 0.072, 0.066},
    { 0.085, 0.045, 0.045, 0.043},
    { 0.092, 0.022, 0.022, 0.021},
};

constexpr Ring kThumb[] = {
    {-0.240, 0.020, 0.020, 0.020},
    {-0.234, 0.038, 0.038, 0.038},
    {-0.205, 0.052, 0.052, 0.050},
    {-0.140, 0.057, 0.058, 0.053},
    {-0.060, 0.060, 0.062, 0.054},
    { 0.020, 0.055, 0.055, 0.048},
    { 0.040, 0.025, 0.025, 0.022},
};

// clang-format on
// From the thumb's tip to its root; it points forward and down.
constexpr LoftFrame kThumbFrame{{0.065, 0, -0.13}, {0, -1, 0}, {0.83, 0, 0.55}, {-0.55, 0, 0.83}};

}  // namespace

std::vector<node::Patch> make_upper_limb() {
  Net net;
  add_loft(net, {.rings = kUpperLimb});
  return fill_cube(net);
}

std::vector<node::Patch> make_lower_limb() {
  Net net;
  add_loft(net, {.rings = kLowerLimb});
  return fill_cube(net);
}

std::vector<node::Patch> make_hand() {
  Net net;
  add_loft(net, {.rings = kMitten});
  add_loft(net, {.rings = kThumb, .around = 8, .frame = kThumbFrame});
  return fill_cube(net);
}

}  // namespace mars::host
