// All connections of the server, and which of them gives way where there are too many: of those that are no page's, the
// one that has sent no request for the longest time.
#pragma once

#include <cstddef>
#include <functional>
#include <list>
#include <memory>
#include <optional>

namespace mars::web {

class Crowd : public std::enable_shared_from_this<Crowd> {
 public:
  // Of one connection, which is counted as long as this lives.
  class Place {
   public:
    explicit Place(std::shared_ptr<Crowd> crowd);
    ~Place();
    Place(const Place&) = delete;
    Place& operator=(const Place&) = delete;

    // From now on the connection may have to give way: it ends when this is called.
    void may_give_way(std::function<void()> end);
    void request_came();
    void becomes_page();

   private:
    std::shared_ptr<Crowd> crowd_;
    std::optional<std::list<std::function<void()>>::iterator> at_;
  };

  std::unique_ptr<Place> enter() { return std::make_unique<Place>(shared_from_this()); }
  std::size_t size() const { return size_; }
  // Has one connection end; false: all are pages'.
  bool make_room();

 private:
  std::size_t size_ = 0;
  std::list<std::function<void()>> ends_;  // of those that may give way, the most silent first
};

}  // namespace mars::web
