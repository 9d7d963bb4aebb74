#include "host/studio/web/crowd.h"

#include <utility>

namespace mars::web {

Crowd::Place::Place(std::shared_ptr<Crowd> crowd) : crowd_(std::move(crowd)) { ++crowd_->size_; }

Crowd::Place::~Place() {
  becomes_page();
  --crowd_->size_;
}

void Crowd::Place::may_give_way(std::function<void()> end) {
  at_ = crowd_->ends_.insert(crowd_->ends_.end(), std::move(end));
}

void Crowd::Place::request_came() {
  if (at_) crowd_->ends_.splice(crowd_->ends_.end(), crowd_->ends_, *at_);
}

void Crowd::Place::becomes_page() {
  if (at_) crowd_->ends_.erase(*at_);
  at_.reset();
}

// The place is given up a moment later: until then others come before it.
bool Crowd::make_room() {
  if (ends_.empty()) return false;
  ends_.splice(ends_.end(), ends_, ends_.begin());
  ends_.back()();
  return true;
}

}  // namespace mars::web
