/* int128.h - integers of 128 bits. */
#ifndef GEOM_INT128_H
#define GEOM_INT128_H

__extension__ typedef __int128 int128;
__extension__ typedef unsigned __int128 uint128;

#endif
