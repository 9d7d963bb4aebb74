#include "host/studio/web/tls.h"

#include <boost/asio/ssl/context.hpp>

#include "hal/failure/failure.h"

namespace mars::web {

namespace ssl = boost::asio::ssl;

std::unique_ptr<ssl::context> make_tls(const std::string& certificate, const std::string& key) {
  auto context = std::make_unique<ssl::context>(ssl::context::tls_server);
  context->set_options(ssl::context::default_workarounds | ssl::context::no_sslv2 | ssl::context::no_sslv3 |
                       ssl::context::no_tlsv1 | ssl::context::no_tlsv1_1 | ssl::context::no_compression);
  boost::system::error_code problem;
  context->use_certificate_chain_file(certificate, problem);
  if (problem)
    throw Failure("the certificate cannot be used: " + problem.message(), certificate,
                  "give a PEM file that may be read to --certificate");
  context->use_private_key_file(key, ssl::context::pem, problem);
  if (problem)
    throw Failure("the key cannot be used: " + problem.message(), key,
                  "give the certificate's key, a PEM file without a passphrase that may be read, to --key");
  return context;
}

}  // namespace mars::web
