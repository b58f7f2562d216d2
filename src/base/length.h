/* length.h - units of length on paper. */
#ifndef BASE_LENGTH_H
#define BASE_LENGTH_H

/* Millimetres of the unit [text, end), of which nothing is mm; 0 where there
 * is no such unit. */
double length_unit_mm(const char *text, const char *end);

#endif
