// The certificate that the studio shows over TLS.
#pragma once

#include <memory>
#include <string>

namespace boost::asio::ssl {
class context;
}

namespace mars::web {

// TLS 1.2 and newer, with a chain of certificates and its key in PEM files. Throws Failure.
std::unique_ptr<boost::asio::ssl::context> make_tls(const std::string& certificate, const std::string& key);

}  // namespace mars::web
