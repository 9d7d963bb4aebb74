// typesel against a twin that lists what it selects.
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "hal/messages/message_types.h"

namespace mars::messages {
namespace {

bool twin_selects(std::int64_t typesel, std::int64_t type) {
  std::int64_t narrow = typesel & 0xffffffff;
  if (narrow >= 0x80000000) narrow -= 0x100000000;
  if (narrow >= 0) return type == narrow;
  if (type > 999'999'999) return false;
  for (int bit = 0; bit < 30; ++bit) {
    if (type == bit) return (narrow & (std::int64_t{1} << bit)) != 0;
  }
  return (narrow & (std::int64_t{1} << 30)) != 0;
}

std::vector<std::int32_t> some_types() {
  std::vector<std::int32_t> types;
  for (int type = 0; type < 40; ++type) types.push_back(type);
  for (const int edge :
       {1'000, 999'999'999, 1'000'000'000, 1'073'741'823, 1'073'741'824, 1'999'999'999, 2'000'000'000}) {
    types.push_back(edge);
  }
  return types;
}

TEST(Typesel, AgreesWithItsTwin) {
  std::vector<std::int64_t> typesels = {-1,         -2,        0x80000007,  0xffffffff,
                                        0xc0000000, INT32_MIN, 0x100000005, -0x100000000};
  for (const std::int32_t type : some_types()) typesels.push_back(type);
  for (int bit = 0; bit < 31; ++bit) typesels.push_back(INT32_MIN | (std::int64_t{1} << bit));
  std::uint64_t random = 1;
  for (int i = 0; i < 5000; ++i) {
    random = random * 6364136223846793005u + 1442695040888963407u;
    typesels.push_back(static_cast<std::int32_t>(random >> 32) | INT32_MIN);
  }
  for (const std::int64_t typesel : typesels) {
    for (const std::int32_t type : some_types()) {
      ASSERT_EQ(selects(narrow_typesel(typesel), type), twin_selects(typesel, type)) << typesel << " " << type;
    }
  }
}

TEST(Typesel, MinusOneIsEveryOrdinaryTypeAndNoOther) {
  for (const std::int32_t type : some_types()) {
    EXPECT_EQ(selects(-1, type), type_class(type) == TypeClass::ordinary) << type;
  }
}

TEST(TypeClasses, HaveTheirEdges) {
  EXPECT_EQ(type_class(-1), TypeClass::reserved);
  EXPECT_EQ(type_class(0), TypeClass::ordinary);
  EXPECT_EQ(type_class(999'999'999), TypeClass::ordinary);
  EXPECT_EQ(type_class(1'000'000'000), TypeClass::reserved);
  EXPECT_EQ(type_class(1'073'741'823), TypeClass::reserved);
  EXPECT_EQ(type_class(1'073'741'824), TypeClass::force);
  EXPECT_EQ(type_class(1'999'999'999), TypeClass::force);
  EXPECT_EQ(type_class(2'000'000'000), TypeClass::reserved);
  EXPECT_EQ(type_class(kFirstInternalType), TypeClass::reserved);
  EXPECT_EQ(type_class(kFirstInternalType + kInternalTypes - 1), TypeClass::reserved);
}

}  // namespace
}  // namespace mars::messages
