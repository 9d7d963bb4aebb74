#include "host/window/screen/window.h"

#include <SDL.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <string_view>

#include "hal/failure/failure.h"
#include "host/child/environment.h"

namespace mars::window {
namespace {

using images::PictureSize;
using pictures::Key;
using pictures::SpecialKey;

constexpr int kFrame = 48;  // pixels, that a window manager may put around a window

[[noreturn]] void fail(const std::string& what) {
  throw Failure(what + ": " + SDL_GetError(), "", "check DISPLAY; over ssh, use ssh -X; or ");
}

// SDL would also draw on the screen of a machine without a window system, to which a person may be logged in from
// elsewhere.
void expect_display() {
  const child::Environment environment = child::own_environment();
  for (const char* name : {"DISPLAY", "WAYLAND_DISPLAY", "SDL_VIDEODRIVER"})
    if (!environment.value(name).value_or("").empty()) return;
  throw Failure("there is no display for a window: neither DISPLAY nor WAYLAND_DISPLAY is set", "",
                "start MARS from a desktop, or over ssh -X; or ");
}

// SDL may draw where it is not seen; a person's SDL_VIDEODRIVER goes before ours.
void choose_ways() {
  SDL_SetHint(SDL_HINT_VIDEODRIVER, "x11,wayland");
  SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");
  SDL_SetHint(SDL_HINT_VIDEO_ALLOW_SCREENSAVER, "1");
  SDL_SetHint(SDL_HINT_VIDEO_X11_NET_WM_BYPASS_COMPOSITOR, "0");
}

std::optional<SpecialKey> special_key(const SDL_Keysym& key) {
  switch (key.sym) {
    case SDLK_UP: return SpecialKey::up;
    case SDLK_DOWN: return SpecialKey::down;
    case SDLK_RIGHT: return SpecialKey::right;
    case SDLK_LEFT: return SpecialKey::left;
    case SDLK_HOME: return SpecialKey::home;
    case SDLK_END: return SpecialKey::end;
    case SDLK_ESCAPE: return SpecialKey::escape;
    case SDLK_TAB: return (key.mod & KMOD_SHIFT) != 0 ? std::optional(SpecialKey::back_tab) : std::nullopt;
    default: return std::nullopt;
  }
}

// Keys that are characters in a terminal, though no text.
char character_of(const SDL_Keysym& key) {
  switch (key.sym) {
    case SDLK_TAB: return '\t';
    case SDLK_RETURN:
    case SDLK_KP_ENTER: return '\r';
    case SDLK_c: return (key.mod & KMOD_CTRL) != 0 ? '\x03' : '\0';
    default: return '\0';
  }
}

void add_key(std::vector<Event>& events, const SDL_Keysym& key) {
  if (const auto special = special_key(key))
    events.emplace_back(Key{*special, 0});
  else if (const char character = character_of(key); character != '\0')
    events.emplace_back(Key{SpecialKey::none, static_cast<std::uint32_t>(character)});
}

// As the keyboard's layout has it.
void add_text(std::vector<Event>& events, std::string_view text) {
  if (text.size() == 1 && std::isprint(static_cast<unsigned char>(text.front())) != 0)
    events.emplace_back(Key{SpecialKey::none, static_cast<unsigned char>(text.front())});
}

void add_event(std::vector<Event>& events, const SDL_Event& event) {
  switch (event.type) {
    case SDL_QUIT: events.emplace_back(Closed{}); return;
    case SDL_KEYDOWN: return add_key(events, event.key.keysym);
    case SDL_TEXTINPUT: return add_text(events, event.text.text);
    case SDL_MOUSEMOTION:
      if ((event.motion.state & SDL_BUTTON_LMASK) != 0)
        events.emplace_back(Dragged{{event.motion.xrel, event.motion.yrel}});
      return;
    case SDL_WINDOWEVENT:
      if (event.window.event == SDL_WINDOWEVENT_CLOSE) events.emplace_back(Closed{});
      if (event.window.event == SDL_WINDOWEVENT_EXPOSED || event.window.event == SDL_WINDOWEVENT_SIZE_CHANGED)
        events.emplace_back(Exposed{});
      return;
    default: return;
  }
}

// Of about the picture's shape, where the screen is smaller.
PictureSize size_on_screen(PictureSize picture) {
  SDL_Rect screen;
  if (SDL_GetDisplayUsableBounds(0, &screen) != 0) return picture;
  const double room = std::min(std::max(screen.w - kFrame, 1) / static_cast<double>(picture.width),
                               std::max(screen.h - kFrame, 1) / static_cast<double>(picture.height));
  if (room >= 1) return picture;
  return {std::max(static_cast<std::uint32_t>(picture.width * room), 1u),
          std::max(static_cast<std::uint32_t>(picture.height * room), 1u)};
}

}  // namespace

Window::Window() {
  expect_display();
  choose_ways();
  if (SDL_Init(SDL_INIT_VIDEO) != 0) fail("no window can be opened");
  // Pixels go straight to an X server: textures would send it the whole window each time.
  if (std::string_view(SDL_GetCurrentVideoDriver()) != "wayland") SDL_SetHint(SDL_HINT_FRAMEBUFFER_ACCELERATION, "0");
}

Window::~Window() {
  window_.reset();
  SDL_Quit();
}

void Window::Destroy::operator()(SDL_Window* window) const { SDL_DestroyWindow(window); }

void Window::open(const std::string& title, PictureSize picture) {
  const PictureSize size = size_on_screen(picture);
  window_.reset(SDL_CreateWindow(title.c_str(), SDL_WINDOWPOS_UNDEFINED, SDL_WINDOWPOS_UNDEFINED,
                                 static_cast<int>(size.width), static_cast<int>(size.height),
                                 SDL_WINDOW_RESIZABLE | SDL_WINDOW_ALLOW_HIGHDPI));
  if (!window_) fail("no window can be opened");
}

void Window::set_title(const std::string& title) { SDL_SetWindowTitle(window_.get(), title.c_str()); }

std::vector<Event> Window::events() {
  std::vector<Event> events;
  for (SDL_Event event; SDL_PollEvent(&event) == 1;) add_event(events, event);
  return events;
}

PictureSize Window::size() const {
  int width = 0, height = 0;
  SDL_GetWindowSizeInPixels(window_.get(), &width, &height);
  return {static_cast<std::uint32_t>(std::max(width, 1)), static_cast<std::uint32_t>(std::max(height, 1))};
}

void Window::show(Canvas& canvas, std::span<const Area> areas) {
  SDL_Surface* shown = SDL_GetWindowSurface(window_.get());
  if (shown == nullptr) fail("the window cannot be drawn");
  const int width = static_cast<int>(canvas.size().width), height = static_cast<int>(canvas.size().height);
  const std::unique_ptr<SDL_Surface, decltype(&SDL_FreeSurface)> drawn(
      SDL_CreateRGBSurfaceWithFormatFrom(canvas.pixels().data(), width, height, 32, 4 * width,
                                         SDL_PIXELFORMAT_XBGR8888),
      SDL_FreeSurface);
  if (!drawn) fail("the window cannot be drawn");
  std::vector<SDL_Rect> rects;
  for (const Area& area : areas) {
    SDL_Rect rect{static_cast<int>(area.x), static_cast<int>(area.y), static_cast<int>(area.width),
                  static_cast<int>(area.height)};
    rects.push_back(rect);
    SDL_BlitSurface(drawn.get(), &rect, shown, &rect);
  }
  if (!rects.empty()) SDL_UpdateWindowSurfaceRects(window_.get(), rects.data(), static_cast<int>(rects.size()));
}

}  // namespace mars::window
