/* limit.h - how many points, corners or faces a scene may have. */
#ifndef SCENE_LIMIT_H
#define SCENE_LIMIT_H

/* So many fit in 32 bits with room to spare for SCENE_NONE and for what the
 * sheet adds to them. */
#define SCENE_LIMIT (UINT32_C(1) << 31)

#endif
