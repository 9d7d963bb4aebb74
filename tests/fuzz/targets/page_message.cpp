// What pages of the studio say.
#include "host/studio/web/page_message.h"
#include "tests/fuzz/target.h"

namespace mars::fuzz::page_message {

void take(std::string_view input) { web::read_page_message(input); }

const Target target("page_message", Form::text, take);

}  // namespace mars::fuzz::page_message
