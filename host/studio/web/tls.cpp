#include "host/studio/web/tls.h"

#include <string>

#include <boost/asio/buffer.hpp>
#include <boost/asio/ssl/context.hpp>

#include "hal/failure/failure.h"
#include "host/content/document/file.h"

namespace mars::web {

namespace ssl = boost::asio::ssl;

std::unique_ptr<ssl::context> make_tls(const std::string& certificate, const std::string& key) {
  auto context = std::make_unique<ssl::context>(ssl::context::tls_server);
  context->set_options(ssl::context::default_workarounds | ssl::context::no_sslv2 | ssl::context::no_sslv3 |
                       ssl::context::no_tlsv1 | ssl::context::no_tlsv1_1 | ssl::context::no_compression);
  // Otherwise OpenSSL asks on the terminal for the passphrase of a key.
  context->set_password_callback([](std::size_t, ssl::context::password_purpose) { return std::string(); });
  constexpr std::uintmax_t kLargestFile = 1 << 20;
  boost::system::error_code problem;  // its words are OpenSSL's
  const std::string chain = document::read_file(certificate, kLargestFile),
                    secret = document::read_file(key, kLargestFile);
  context->use_certificate_chain(boost::asio::buffer(chain), problem);
  if (problem)
    throw Failure("the certificate cannot be used: it is no PEM file of certificates", certificate,
                  "give a PEM file to --certificate, which begins with -----BEGIN CERTIFICATE-----");
  context->use_private_key(boost::asio::buffer(secret), ssl::context::pem, problem);
  if (problem)
    throw Failure("the key cannot be used: it is no PEM file without a passphrase, or another certificate's", key,
                  "give the key of " + certificate + " to --key");
  return context;
}

}  // namespace mars::web
