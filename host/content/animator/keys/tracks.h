// The keys of one thing of a film file - camera, light, material or actor - taken apart into tracks, one a part
// that changes, and put together again. A key of the file holds several parts and an ease, for parts that have none of
// their own.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "host/content/animator/pose/ease.h"
#include "host/content/document/json_file.h"

namespace mars::animator {

struct TrackKey {
  std::uint32_t frame;
  document::Json value;
  Ease ease;                   // to the next key of the part
  document::Json in{}, out{};  // slopes of splines, a frame; null: none
};

// By part: "place", "turn", "eye", ...; a joint's pose is "/" and its name. Frames ascend.
using Track = std::vector<TrackKey>;
using Tracks = std::map<std::string, Track>;

Tracks tracks_of(const document::Json& thing);
Tracks tracks_of(const document::Json& thing, const std::vector<std::string>& parts);  // of `parts` alone

// Makes them the thing's keys; still values of what is keyed now go. Where parts of one frame have several eases, the
// key keeps the one it has, if any part has it, else has that of most; the others have their own.
void put_tracks(document::Json& thing, const Tracks& tracks);

// Whether anything changes from the track's key to the next.
bool leads_on(const Track& track, const TrackKey& key);

// The key at the frame; null if there is none.
TrackKey* key_at(Track& track, std::uint32_t frame);

// Puts a key in its place, instead of one at its frame.
void put_key(Track& track, TrackKey key);

// Gives the parts' keys at the frame an ease.
void set_ease(Tracks& tracks, const std::set<std::string>& parts, std::uint32_t frame, const Ease& ease);

// As people name a part: joints without the slash.
std::string shown_part(const std::string& part);

}  // namespace mars::animator
