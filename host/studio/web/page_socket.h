// The WebSocket of a page.
#pragma once

#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/message.hpp>
#include <memory>

#include "host/studio/web/crowd.h"
#include "host/studio/web/site.h"
#include "host/studio/web/stream.h"

namespace mars::web {

using HttpRequest = boost::beast::http::request<boost::beast::http::empty_body>;

// The request, which passed the gate, becomes a page's WebSocket; it lives by itself as serve_connection's.
void serve_page(Stream stream, const HttpRequest& request, Site& site, std::unique_ptr<Crowd::Place> place);

}  // namespace mars::web
