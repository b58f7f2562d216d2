/* sanitizer.h - which sanitizers this is compiled with, by gcc or clang. */
#ifndef BASE_SANITIZER_H
#define BASE_SANITIZER_H

#ifdef __has_feature
#define SANITIZER_HAS_FEATURE(name) __has_feature(name)
#else
#define SANITIZER_HAS_FEATURE(name) 0
#endif

#if defined __SANITIZE_ADDRESS__ || SANITIZER_HAS_FEATURE(address_sanitizer)
#define SANITIZER_OF_ADDRESSES 1
#else
#define SANITIZER_OF_ADDRESSES 0
#endif

#if defined __SANITIZE_THREAD__ || SANITIZER_HAS_FEATURE(thread_sanitizer)
#define SANITIZER_OF_THREADS 1
#else
#define SANITIZER_OF_THREADS 0
#endif

#endif
