// Fortran's entry points of nx_paragon.h, and those of nx_messages.h that end what irecvx began.
#include "hal/nx/nx_paragon.h"

#include <algorithm>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

#include "hal/fortran/fortran.h"

using namespace mars::fortran;

namespace {

// What a call says of a message in longs, for a caller with INTEGERs.
class MessageInfo {
 public:
  explicit MessageInfo(Integer info[8]) : info_(info) { std::copy_n(info, 8, longs_); }
  long* longs() { return longs_; }
  void pass_on() const { std::transform(longs_, longs_ + 8, info_, narrow); }

 private:
  Integer* info_;
  long longs_[8];
};

// Of receives under way, by id; and those that go on without one.
std::multimap<long, std::unique_ptr<MessageInfo>> infos;
std::multimap<long, std::unique_ptr<MessageInfo>> ignored;
std::mutex mutex;

void pass_on(long mid) {
  const std::lock_guard lock(mutex);
  const auto [first, last] = infos.equal_range(mid);
  std::for_each(first, last, [](const auto& entry) { entry.second->pass_on(); });
  infos.erase(first, last);
}

// Hands what belongs to `mid` to another id, in `to`.
void move_on(long mid, long other, std::multimap<long, std::unique_ptr<MessageInfo>>& to) {
  if (mid == other && &to == &infos) return;
  const std::lock_guard lock(mutex);
  for (auto at = infos.find(mid); at != infos.end(); at = infos.find(mid)) {
    auto message_info = infos.extract(at);
    message_info.key() = other;
    to.insert(std::move(message_info));
  }
}

using Handler = void (*)(const Integer* type, const Integer* length, const Integer* node, const Integer* ptype,
                         const Integer* parameter);

// A subroutine and the number that goes with it: until its one call.
struct Call {
  Handler proc;
  Integer parameter;
};

void call_handler(long type, long length, long node, long ptype, long call) {
  const std::unique_ptr<Call> known(reinterpret_cast<Call*>(call));
  const Integer arguments[] = {narrow(type), narrow(length), narrow(node), narrow(ptype), known->parameter};
  known->proc(&arguments[0], &arguments[1], &arguments[2], &arguments[3], &arguments[4]);
}

long make_call(Handler proc, const Integer* parameter) { return reinterpret_cast<long>(new Call{proc, *parameter}); }

}  // namespace

extern "C" {

void crecvx_(const Integer* typesel, void* buf, const Integer* len, const Integer* node, const Integer* ptype,
             Integer info[8]) {
  MessageInfo message_info(info);
  crecvx(*typesel, buf, *len, *node, *ptype, message_info.longs());
  message_info.pass_on();
}
Integer irecvx_(const Integer* typesel, void* buf, const Integer* len, const Integer* node, const Integer* ptype,
                Integer info[8]) {
  auto message_info = std::make_unique<MessageInfo>(info);
  const long mid = irecvx(*typesel, buf, *len, *node, *ptype, message_info->longs());
  const std::lock_guard lock(mutex);
  infos.emplace(mid, std::move(message_info));
  return narrow(mid);
}
void cprobex_(const Integer* typesel, const Integer* node, const Integer* ptype, Integer info[8]) {
  MessageInfo message_info(info);
  cprobex(*typesel, *node, *ptype, message_info.longs());
  message_info.pass_on();
}
Integer iprobex_(const Integer* typesel, const Integer* node, const Integer* ptype, Integer info[8]) {
  MessageInfo message_info(info);
  const long found = iprobex(*typesel, *node, *ptype, message_info.longs());
  message_info.pass_on();
  return narrow(found);
}

void msgwait_(const Integer* mid) {
  msgwait(*mid);
  pass_on(*mid);
}
Integer msgdone_(const Integer* mid) {
  const long done = msgdone(*mid);
  if (done == 1) pass_on(*mid);
  return narrow(done);
}
void msgcancel_(const Integer* mid) {
  msgcancel(*mid);
  const std::lock_guard lock(mutex);
  infos.erase(*mid);
}
Integer msgmerge_(const Integer* mid1, const Integer* mid2) {
  const long merged = msgmerge(*mid1, *mid2);
  move_on(*mid1, merged, infos);
  move_on(*mid2, merged, infos);
  return narrow(merged);
}
void msgignore_(const Integer* mid) {
  msgignore(*mid);
  move_on(*mid, *mid, ignored);
}

void hsendx_(const Integer* type, const void* buf, const Integer* len, const Integer* node, const Integer* ptype,
             Handler proc, const Integer* parameter) {
  hsendx(*type, buf, *len, *node, *ptype, call_handler, make_call(proc, parameter));
}
void hrecvx_(const Integer* typesel, void* buf, const Integer* len, const Integer* node, const Integer* ptype,
             Handler proc, const Integer* parameter) {
  hrecvx(*typesel, buf, *len, *node, *ptype, call_handler, make_call(proc, parameter));
}

Integer infoptype_() { return narrow(infoptype()); }
Integer myptype_() { return narrow(myptype()); }
void setptype_(const Integer* ptype) { setptype(*ptype); }

}  // extern "C"
