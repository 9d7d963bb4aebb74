// The crystal router: parcels for some nodes, which do not know of them.
#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "hal/collectives/crystal_router.h"
#include "hal/messages/collective_method.h"
#include "hal/messages/process.h"
#include "hal/nx/nx_messages.h"
#include "tests/hal/conformance/expect.h"
#include "tests/hal/conformance/rules.h"
#include "tests/hal/conformance/talk.h"

namespace mars::conformance {
namespace {

constexpr collectives::Route kRoutes[] = {collectives::Route::automatic, collectives::Route::crystal,
                                          collectives::Route::direct, collectives::Route::network};

std::string text_of(const collectives::Parcel& parcel) {
  return std::string(reinterpret_cast<const char*>(parcel.bytes.data()), parcel.bytes.size());
}

// Some nodes get several parcels of one sender, some none.
long parcels_between(long from, long to) { return (from * 3 + to) % 3; }

std::string parcel_of(long from, long to, long number) {
  const long length = (from * 5 + to * 3 + number) % 7 == 0 ? 30'000 : (from + to + number) % 50;
  return std::string(static_cast<std::size_t>(length), static_cast<char>('a' + (from + 2 * to + number) % 26));
}

// The last one first.
std::vector<collectives::Parcel> parcels_of(const std::vector<std::string>& texts) {
  std::vector<collectives::Parcel> parcels;
  for (long to = 0; to < numnodes(); ++to)
    for (long number = 0; number < parcels_between(mynode(), to); ++number)
      parcels.push_back({static_cast<int>(to), std::as_bytes(std::span(texts[parcels.size()]))});
  std::reverse(parcels.begin(), parcels.end());
  return parcels;
}

void expect_parcels(std::span<const collectives::Parcel> got) {
  std::size_t next = 0;
  for (long from = 0; from < numnodes(); ++from)
    for (long number = parcels_between(from, mynode()); number-- > 0; ++next) {
      expect(next < got.size(), "no parcel is lost");
      expect_equal(got[next].node, from);
      expect(text_of(got[next]) == parcel_of(from, mynode(), number), "the parcel is whole, and in its order");
    }
  expect_equal(next, got.size());
}

RULE(parcels_by_every_route, "parcels come by sender, and of each sender in its order, whatever the route",
     "none is lost, none comes twice, and a route that was taken before leaves nothing behind") {
  if (is_host()) return;
  std::vector<std::string> texts;
  for (long to = 0; to < numnodes(); ++to)
    for (long number = 0; number < parcels_between(mynode(), to); ++number)
      texts.push_back(parcel_of(mynode(), to, number));
  const std::vector<collectives::Parcel> parcels = parcels_of(texts);
  const collectives::Group all = {0, static_cast<int>(numnodes())};
  collectives::CrystalRouter router;
  for (const collectives::Route route : kRoutes) expect_parcels(router.exchange(all, parcels, route));
  for (const messages::CollectiveMethod means :
       {messages::CollectiveMethod::network, messages::CollectiveMethod::cube, messages::CollectiveMethod::automatic}) {
    messages::process().set_collectives(means);
    expect_parcels(router.exchange(all, parcels));
  }
}

RULE(parcels_within_a_group, "each half of the nodes exchanges parcels among themselves",
     "the other half gets none of them") {
  if (is_host() || numnodes() == 1) return;
  const auto nodes = static_cast<int>(numnodes()), me = static_cast<int>(mynode());
  const collectives::Group half = collectives::group_of(nodes, 2, me < nodes / 2 ? 0 : 1);
  const auto beside = [&](int step) { return half.first + (me - half.first + half.count + step) % half.count; };
  const std::string text = std::to_string(mynode());
  const std::vector<collectives::Parcel> parcels = {{beside(1), std::as_bytes(std::span(text))}};
  collectives::CrystalRouter router;
  for (const collectives::Route route : kRoutes) {
    const std::span<const collectives::Parcel> got = router.exchange(half, parcels, route);
    expect_equal(got.size(), 1);
    expect_equal(got[0].node, beside(-1));
    expect_equal(text_of(got[0]), std::to_string(beside(-1)));
  }
}

}  // namespace
}  // namespace mars::conformance
