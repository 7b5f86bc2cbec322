// yade-blocks, GPL-2.0-or-later
#pragma once

/// A function whose loops are compiled twice: for every processor, and wider for those with AVX2, which is chosen when the program
/// starts. Without fused operations the bits are the same. -DBLOCKS_WIDE=OFF leaves the wide clones out.
#ifdef BLOCKS_NOT_WIDE
#define WIDE
#else
#define WIDE __attribute__((target_clones("avx2", "default")))
#endif
