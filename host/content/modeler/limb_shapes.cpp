#include "host/content/modeler/limb_shapes.h"

#include "host/content/modeler/loft.h"

namespace mars::modeler {
namespace {

// Rings as in body_shapes.cpp: at, front, back, width. The joint is at 0, the next one at -1; a hand is half
// as long. At either joint the end is half a ball, of equal radius where limbs meet.
// clang-format off

constexpr Ring kUpperLimb[] = {
    {-1.110, 0.014, 0.014, 0.014},
    {-1.104, 0.043, 0.043, 0.043},
    {-1.080, 0.080, 0.080, 0.080},
    {-1.043, 0.104, 0.104, 0.104},
    {-1.000, 0.113, 0.113, 0.113},
    {-0.850, 0.118, 0.115, 0.115},
    {-0.660, 0.136, 0.126, 0.128},
    {-0.480, 0.160, 0.142, 0.147},
    {-0.300, 0.174, 0.156, 0.161},
    {-0.130, 0.173, 0.162, 0.166},
    { 0.000, 0.166, 0.163, 0.165},
    { 0.063, 0.152, 0.152, 0.152},
    { 0.116, 0.116, 0.116, 0.116},
    { 0.152, 0.063, 0.063, 0.063},
    { 0.160, 0.021, 0.021, 0.021},
};

constexpr Ring kLowerLimb[] = {
    {-1.072, 0.009, 0.009, 0.009},
    {-1.068, 0.028, 0.028, 0.028},
    {-1.052, 0.052, 0.052, 0.052},
    {-1.028, 0.068, 0.068, 0.068},
    {-1.000, 0.073, 0.073, 0.073},
    {-0.860, 0.074, 0.077, 0.075},
    {-0.710, 0.081, 0.098, 0.084},
    {-0.550, 0.093, 0.136, 0.102},
    {-0.400, 0.102, 0.165, 0.116},
    {-0.260, 0.109, 0.160, 0.121},
    {-0.120, 0.113, 0.132, 0.118},
    { 0.000, 0.112, 0.114, 0.113},
    { 0.043, 0.104, 0.104, 0.104},
    { 0.080, 0.080, 0.080, 0.080},
    { 0.104, 0.043, 0.043, 0.043},
    { 0.110, 0.014, 0.014, 0.014},
};

constexpr Ring kMitten[] = {
    {-0.500, 0.024, 0.024, 0.012},
    {-0.494, 0.070, 0.070, 0.034},
    {-0.462, 0.112, 0.112, 0.052},
    {-0.380, 0.138, 0.136, 0.064},
    {-0.260, 0.146, 0.140, 0.071},
    {-0.130, 0.122, 0.118, 0.076},
    {-0.050, 0.090, 0.090, 0.077},
    { 0.000, 0.076, 0.076, 0.074},
    { 0.028, 0.068, 0.068, 0.068},
    { 0.052, 0.052, 0.052, 0.052},
    { 0.068, 0.028, 0.028, 0.028},
    { 0.072, 0.009, 0.009, 0.009},
};

constexpr Ring kThumb[] = {
    {-0.215, 0.007, 0.007, 0.007},
    {-0.212, 0.022, 0.022, 0.021},
    {-0.200, 0.041, 0.041, 0.039},
    {-0.172, 0.054, 0.054, 0.051},
    {-0.130, 0.058, 0.059, 0.056},
    {-0.070, 0.062, 0.066, 0.066},
    {-0.010, 0.064, 0.066, 0.080},
    { 0.050, 0.056, 0.056, 0.076},
    { 0.085, 0.025, 0.025, 0.036},
};

// clang-format on
// From the thumb's tip to its root; it points forward and down.
constexpr LoftFrame kThumbFrame{{0.065, 0, -0.13}, {0, -1, 0}, {0.83, 0, 0.55}, {-0.55, 0, 0.83}};

}  // namespace

std::vector<wire::Patch> make_upper_limb() {
  Net net;
  add_loft(net, {.rings = kUpperLimb});
  return fill_cube(net);
}

std::vector<wire::Patch> make_lower_limb() {
  Net net;
  add_loft(net, {.rings = kLowerLimb});
  return fill_cube(net);
}

std::vector<wire::Patch> make_hand() {
  Net net;
  add_loft(net, {.rings = kMitten});
  add_loft(net, {.rings = kThumb, .around = 8, .frame = kThumbFrame});
  return fill_cube(net);
}

}  // namespace mars::modeler
