/* Arrays with several numbers a pixel, one plane of the film after another, so that the same number of pixels
   side by side can be read and worked on at once. Rows are a multiple of WEDGE_LANES floats long; what lies between the
   film's edge and the end of a row is 0, and so is a margin before the first plane and after the last, where eight
   pixels are read of which some are beside the film. */
#ifndef WEDGE_SHARED_PLANES_H
#define WEDGE_SHARED_PLANES_H

#define WEDGE_LANES 8

/* Floats in a row. */
#define WEDGE_PLANE_PITCH(width) (((width) + WEDGE_LANES - 1) / WEDGE_LANES * WEDGE_LANES)
#define WEDGE_PLANE_MARGIN WEDGE_LANES

#endif
