#include "host/shell/launch/hostfile.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/host/content/document/failure_of.h"
#include "tests/temporary_folder.h"

namespace mars::launch {
namespace {

class Hostfile : public testing::Test {
 protected:
  std::vector<Slots> read(const std::string& text) {
    std::ofstream(folder_ / "hosts") << text;
    return read_hostfile(folder_ / "hosts");
  }

  // "n1:2 n2:1 "
  std::string machines(const std::string& text) {
    std::string found;
    for (const Slots& slots : read(text)) found += slots.host + ":" + std::to_string(slots.count) + " ";
    return found;
  }

  std::string failure(const std::string& text) {
    return document::failure_of([&] { read(text); });
  }

  const test::TemporaryFolder folder_;
};

// What mpirun of Open MPI 4.1.4 took, each tried with it.
TEST_F(Hostfile, IsWhatMpirunTakes) {
  EXPECT_EQ(machines("n1 slots=2\n n2 slots = 3 max-slots=9 # fast\n\n# n3 slots=7\nn4\n"), "n1:2 n2:3 n4:1 ");
  EXPECT_EQ(machines("n1"), "n1:1 ");
  EXPECT_EQ(machines("\tn1\tcpu=2"), "n1:2 ");
  EXPECT_EQ(machines("n1 max_slots=3\nn2 max_slots=2 slots=4\n"), "n1:3 n2:4 ");
  EXPECT_EQ(machines("u@n1 slots=2\nu.v@h.w.\n@n2\n127.0.0.1\n12 slots=02\nfd00::2\n"),
            "u@n1:2 u.v@h.w.:1 @n2:1 127.0.0.1:1 12:2 fd00::2:1 ");
  EXPECT_EQ(machines("n1 port=22 username=ada slots=2\nn2 username 3\nn3 username=\n"), "n1:2 n2:1 n3:1 ");
  EXPECT_EQ(machines("n1 n2\nn3 slots=2 12\nn4 topology\n"), "n1:1 n3:2 n4:1 ") << "it ignores these words";
  EXPECT_EQ(machines("n1//c\nn2#c\n// n3\n/* a\nb */ n4 slots=2\nn5 /* c\nn6\n*/\nn7\n"), "n1:1 n2:1 n4:2 n5:1 n7:1 ");
  EXPECT_EQ(machines("n1\nn1\nn2 slots=2\nn2\n"), "n1:2 n2:3 ");
  EXPECT_EQ(machines("rank 0=n1 slot=0:1\nrank 1=n2 slot=1\nrank 2=n1\n"), "n1:2 n2:1 ");
  EXPECT_EQ(machines("n1 slots=0\nn2 slots=1\n"), "n2:1 ");
  EXPECT_EQ(machines("n1 slots=0\nn2 slots=0\n"), "n1:1 n2:1 ");
  EXPECT_EQ(machines("n1 slots=999999\n"), "n1:999999 ");
  EXPECT_EQ(machines("+n0 slots=2\nn1\n"), "") << "mpirun alone knows which these are";
}

TEST_F(Hostfile, NamesTheLineThatIsWrong) {
  EXPECT_EQ(failure("n1\nn2 slots=many\n"),
            (folder_ / "hosts").string() + ":2: slots has no number (write a line a host, like: n1 slots=4)");
  const std::vector<std::pair<std::string, std::string>> kWrong = {
      {"", "hosts: names no host"},
      {"# none\n", "hosts: names no host"},
      {"n1\nn2 slots 2\n", "hosts:2: slots has no number"},
      {"n1 slots=-1\n", "hosts:1: slots has no number"},
      {"n1 slots=2.5\n", "slots has no number"},
      {"n1 slots=1000000\n", "hosts:1: slots is 1000000, more than any machine has"},
      {"n1 slots=99999999999\n", "slots is 99999999999, more than any machine has"},
      {"n1 slots==2\n", "slots has no number"},
      {"n1 slots=2,\n", "slots has no number"},
      {"n1 port=x\n", "port has no number"},
      {"n1 slots=4 max_slots=2\n", "max_slots is 2, less than slots"},
      {"n1 max-slots=0\n", "max-slots is 0, less than slots"},
      {"n1 slots=2 slots=3\n", "gives the slots of n1 twice"},
      {"n1 slots=2\nn1 slots=3\n", "hosts:2: gives the slots of n1 again"},
      {"n1:2\n", "'n1:2' is no host's name (write: n1 slots=2)"},
      {"n1,n2\n", "'n1,n2' is not the name of one host"},
      {"u@x@n1\n", "is not the name of one host"},
      {"n[1-3]\n", "has a character that no hostfile has: '['"},
      {"^n1\n", "has a character that no hostfile has: '^'"},
      {"n1\r\nn2\r\n", "hosts:1: ends as a line of Windows (convert the file: dos2unix FILE)"},
      {"slots=2\n", "hosts:1: names no host"},
      {"=2\n", "names no host"},
      {"rank=\n", "names no host"},
      {"n1 user=joe\n", "'user' is no word of a hostfile"},
      {"n1 SLOTS=2\n", "'SLOTS' is no word of a hostfile"},
      {"n1 = 2\n", "'=' is no word of a hostfile"},
      {"n1slots=2\n", "'=' is no word of a hostfile"},
      {"n1 slot\n", "'slot' is no word of a hostfile"},
      {"n1 n2.example.org\n", "names a second host, n2.example.org"},
      {"n1\n# c", "hosts:2: the file ends within a comment (end its last line)"},
      {std::string(256, 'y') + "\n", "is no host's name: it is too long"},
  };
  for (const auto& [text, says] : kWrong) EXPECT_TRUE(document::holds(failure(text), says)) << text;
  EXPECT_TRUE(document::holds(document::failure_of([&] { read_hostfile(folder_ / "nowhere"); }), "nowhere"));
  EXPECT_TRUE(document::holds(document::failure_of([&] { read_hostfile(folder_ / ""); }), "is a directory"));
}

TEST_F(Hostfile, OfAnyLength) {
  const std::string long_word(100000, 'y');
  EXPECT_EQ(machines(std::string(255, 'y') + " slots=2\n"), std::string(255, 'y') + ":2 ");
  EXPECT_EQ(machines("n1 " + long_word + " slots=2 #" + long_word + "\n"), "n1:2 ");
}

}  // namespace
}  // namespace mars::launch
