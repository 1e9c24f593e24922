/* How bright a sample may be. */
#ifndef WEDGE_SHARED_RADIANCE_H
#define WEDGE_SHARED_RADIANCE_H

/* 2^51: the squares of as many samples as a film counts, 2^24, add up to a finite float. */
#define WEDGE_LARGEST_RADIANCE 2251799813685248.0f

#endif
