// One connection: HTTP, which may become the WebSocket of a page.
#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <memory>

#include "host/studio/web/crowd.h"
#include "host/studio/web/site.h"

namespace boost::asio::ssl {
class context;
}

namespace mars::web {

// Lives by itself until it ends; `place` lives as long. `tls`: none where there is no TLS.
void serve_connection(boost::asio::ip::tcp::socket socket, boost::asio::ssl::context* tls, Site& site,
                      std::unique_ptr<Crowd::Place> place);

}  // namespace mars::web
