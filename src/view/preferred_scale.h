/* preferred_scale.h - the scales that drawings are made at. */
#ifndef VIEW_PREFERRED_SCALE_H
#define VIEW_PREFERRED_SCALE_H

/* The largest of the scales that [ISO5455] prefers which is not above `scale`,
 * a normal number above 0: 1, 2 or 5 times a power of ten.  One that is above
 * it by no more than rounding errors counts as equal. */
double preferred_scale(double scale);

/* The largest of these scales, times `whole`, that is not above `most`; `most`
 * itself where their ratio is no normal number, so that there is none.
 * whole  the scale 1:1; both above 0 */
double preferred_scale_of(double most, double whole);

#endif
