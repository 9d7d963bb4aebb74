#include "host/json_code.h"

MARS_JSON_CODE(template);
