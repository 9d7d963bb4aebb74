#include "host/studio/web/gate.h"

#include <arpa/inet.h>

#include <algorithm>
#include <cctype>
#include <utility>

#include "host/studio/web/token.h"

namespace mars::web {
namespace {

// Without the port; an IPv6 address keeps its brackets, and whatever else follows them.
std::string_view name_of(std::string_view host) {
  const std::size_t bracket = host.starts_with('[') ? host.find(']') : std::string_view::npos;
  return host.substr(0, host.find(':', bracket == std::string_view::npos ? 0 : bracket));
}

bool is_address(std::string_view name) {
  unsigned char bytes[16];
  const bool v6 = name.size() > 2 && name.front() == '[' && name.back() == ']';
  const std::string text(v6 ? name.substr(1, name.size() - 2) : name);
  return inet_pton(v6 ? AF_INET6 : AF_INET, text.c_str(), bytes) == 1;
}

bool same_name(std::string_view one, std::string_view other) {
  return std::ranges::equal(one, other, [](unsigned char a, unsigned char b) { return tolower(a) == tolower(b); });
}

std::string_view value_in(std::string_view target, std::string_view name) {
  std::size_t at = target.find('?');
  while (at != std::string_view::npos) {
    const std::size_t next = target.find('&', at + 1);
    const std::string_view pair = target.substr(at + 1, next == std::string_view::npos ? next : next - at - 1);
    if (pair.starts_with(name) && pair.substr(name.size()).starts_with('=')) return pair.substr(name.size() + 1);
    at = next;
  }
  return {};
}

}  // namespace

std::string_view path_of(std::string_view target) { return target.substr(0, target.find('?')); }

Gate::Gate(std::string token, bool tls, std::vector<std::string> names)
    : token_(std::move(token)), tls_(tls), names_(std::move(names)) {
  names_.push_back("localhost");
}

bool Gate::is_own(std::string_view host) const {
  const std::string_view name = name_of(host);
  if (name.empty()) return false;
  return tls_ || is_address(name) ||
         std::ranges::any_of(names_, [&](const std::string& own) { return same_name(own, name); });
}

Refusal Gate::check_names(const Request& request) const {
  if (!is_own(request.host)) return {403, "The studio has another name: open the link that it printed.\n"};
  if (!request.origin.empty() && !same_name(request.origin, std::string(scheme()) + "://" + std::string(request.host)))
    return {403, "Pages of other sites may not use the studio.\n"};
  return {};
}

Refusal Gate::check(const Request& request) const {
  if (Refusal refusal = check_names(request); refusal.status != 0) return refusal;
  if (request.method != "GET" && request.method != "HEAD") return {405, "Only GET and HEAD.\n"};
  return {};
}

// A page that a person has opened by the link.
Refusal Gate::check_page(const Request& request) const {
  if (request.origin.empty()) return {403, "No Origin.\n"};
  return check_token(request);
}

Refusal Gate::check_socket(const Request& request) const {
  if (Refusal refusal = check(request); refusal.status != 0) return refusal;
  return check_page(request);
}

Refusal Gate::check_upload(const Request& request) const {
  if (Refusal refusal = check_names(request); refusal.status != 0) return refusal;
  return check_page(request);
}

Refusal Gate::check_token(const Request& request) const {
  if (!same_token(token_, value_in(request.target, "token")))
    return {403, "The token is wrong: open the link that the studio printed last.\n"};
  return {};
}

}  // namespace mars::web
