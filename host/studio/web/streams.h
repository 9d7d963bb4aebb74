// What connections run over, and what the files that know Beast share. Only these include it.
#pragma once

#include <utility>  // Beast 1.74 needs it and does not say so

#include <boost/beast/core.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/ssl.hpp>
#include <memory>

#include "host/studio/web/crowd.h"
#include "host/studio/web/site.h"

namespace mars::web {

using Plain = boost::beast::tcp_stream;
using Tls = boost::beast::ssl_stream<boost::beast::tcp_stream>;
using HttpRequest = boost::beast::http::request<boost::beast::http::empty_body>;
using Error = boost::beast::error_code;

// The request, which passed the gate, becomes a page's WebSocket; it lives by itself as serve_connection's. Of Plain
// and Tls.
template <typename Stream>
void serve_page(Stream stream, const HttpRequest& request, Site& site, std::unique_ptr<Crowd::Place> place);

}  // namespace mars::web
