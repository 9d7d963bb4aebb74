/* What programs of the iPSC/2 and iPSC/860 include: all calls of NX/2. */
#pragma once

#include "nx_byte_order.h"
#include "nx_errno.h"
#include "nx_files.h"
#include "nx_global.h"
#include "nx_host.h"
#include "nx_messages.h"
