// Gives nodes the tasks of a film's plan, each group its own, and a slow node less of them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "host/render/farm/engine.h"
#include "host/render/farm/farm.h"
#include "host/render/farm/film_pictures.h"
#include "host/render/farm/node_rates.h"

namespace mars::farm {

class FilmWork : public WorkGiver {
 public:
  // Of the run that `pictures` are of.
  FilmWork(const FilmRun& run, FilmPictures& pictures);
  FilmWork(const FilmRun&&, auto&&...) = delete;

  bool goes_on() const override { return wanted_ && pictures_.frames_left() > 0; }
  bool give_work() override;
  void note_taken(const wire::Strip& strip) override;

  const std::vector<SlowTime>& slow_times() const { return rates_.slow_times(); }

 private:
  void give_tasks();
  void give_when_asked();
  void give(GroupWork& to);
  void give_portion(GroupWork& to);
  void note_given(const GroupWork& group, const std::vector<Standing>& before, const Portion& portion);
  void adapt(const wire::Strip& last, GroupWork& by);
  void report_slow_nodes();

  const FilmRun& run_;
  FilmPictures& pictures_;
  NodeRates rates_;
  std::size_t next_task_ = 0;
  bool wanted_ = true;
};

}  // namespace mars::farm
