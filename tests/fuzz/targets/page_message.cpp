// What pages of the studio say.
#include "host/studio/web/page_message.h"
#include "tests/fuzz/target.h"

namespace mars::fuzz {

const Form kForm = Form::text;

void take(std::string_view input) { web::read_page_message(input); }

}  // namespace mars::fuzz
