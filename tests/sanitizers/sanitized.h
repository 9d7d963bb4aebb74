// Whether this test is built with a sanitizer: for what a sanitizer makes impossible, as limits of memory, since it
// takes terabytes of addresses when a program starts.
#pragma once

namespace mars::sanitizers {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

// By how much longer what a test bounds may take.
inline constexpr int kSlowness = kSanitized ? 20 : 1;

}  // namespace mars::sanitizers
