/* value.h - the values of options, from text: the same in every locale. */
#ifndef CLI_VALUE_H
#define CLI_VALUE_H

#include <stdbool.h>
#include <stddef.h>

/* All return false, and leave the result alone, where `text` as a whole is
 * not what they read or a number is not finite. */

/* A plain number. */
bool value_number(const char *text, double *number);

/* A whole number. */
bool value_int(const char *text, int *number);

/* Two whole numbers with a sign between them; one alone counts twice. */
bool value_range(const char *text, char between, int *first, int *last);

/* A length on paper: a number and mm (also where it is left out), cm, in or
 * pt. */
bool value_length(const char *text, double *mm);

/* A length on paper of at least 0, or a share of at most 100%, such as 0.5%;
 * the other is 0. */
bool value_tolerance(const char *text, double *mm, double *share);

/* X,Y,Z: three plain numbers. */
bool value_vector(const char *text, double vector[3]);

/* A letter from x to z with a sign or without one, in any case: the unit vector
 * along that axis. */
bool value_axis(const char *text, double vector[3]);

/* A unit of length by its symbol or its name, in any case, such as mm, inch or
 * metres: how many millimetres it is. */
bool value_unit(const char *text, double *mm);

/* A plane, and what is beyond it: x=2 or x>2, y<3, or NX,NY,NZ,D for
 * NX x + NY y + NZ z > D; the normal is not 0. */
bool value_plane(const char *text, double normal[3], double *offset);

/* A page: A0 to A6, letter or legal, upright, in any case; or WxH, two
 * lengths above 0, where a unit of the second serves the first too.
 * is_named  set to whether it was a name */
bool value_page(const char *text, double *width_mm, double *height_mm,
                bool *is_named);

/* A scale above 0: page to scene, such as 1:2, or its quotient. */
bool value_scale(const char *text, double *scale);

/* A comma-separated list of edge classes, all, or none, as a mask. */
bool value_edges(const char *text, unsigned *edges);

/* The class of that name; 0: there is none. */
unsigned value_edge_class(const char *name);

/* One of the space-separated words, its index. */
bool value_word(const char *text, const char *words, int *index);

/* One of the names up to the first NULL, its index. */
bool value_name(const char *text, const char *(*name)(size_t index),
                int *index);

#endif
