// Who may speak with the studio. Other sites in the same browser may not: their pages cannot know the token, send their
// own Origin, and where they made their name an address of this machine (DNS rebinding) they send it as Host.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace mars::web {

struct Request {
  std::string_view method, target;  // target: path and query
  std::string_view host, origin;    // "": none
  std::string_view known;           // If-None-Match
};

struct Refusal {
  unsigned status = 0;  // of HTTP; 0: not refused
  std::string text;
};

class Gate {
 public:
  // `names`: of this machine, beside its addresses and localhost. Over TLS any name is good, as the certificate
  // answers for it.
  Gate(std::string token, bool tls, std::vector<std::string> names);

  const std::string& token() const { return token_; }
  const char* scheme() const { return tls_ ? "https" : "http"; }
  const char* socket_scheme() const { return tls_ ? "wss" : "ws"; }

  // Any request but a POST that uploads a file.
  Refusal check(const Request& request) const;
  // One that needs the token.
  Refusal check_token(const Request& request) const;
  // One for the WebSocket.
  Refusal check_socket(const Request& request) const;
  // A POST that uploads a file: Host, Origin and token.
  Refusal check_upload(const Request& request) const;

 private:
  Refusal check_names(const Request& request) const;
  Refusal check_page(const Request& request) const;
  bool is_own(std::string_view host) const;

  std::string token_;
  bool tls_;
  std::vector<std::string> names_;
};

// "/a/b" of "/a/b?c=d".
std::string_view path_of(std::string_view target);

}  // namespace mars::web
