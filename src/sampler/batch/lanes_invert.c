/* See lanes_invert.h. */
#include "sampler/batch/lanes_invert.h"

#if VNDF_HAS_LANES && VNDF_LANES > 1

#  include "sampler/law.h"

#  if VNDF_LANES == 16
void vndf_invert_block_avx512(const vndf_distribution *d, vndf_invert_block *b)
#  else
void vndf_invert_block_avx2(const vndf_distribution *d, vndf_invert_block *b)
#  endif
{
    b->left_count = 0;
    vndf_law_invert_block(d, b);
}

#endif
