// Products of dense matrices, by columns: what nearly all of a factorisation consists of. Each entry is a sum in the order of the columns of a
// and b, in chunks of a fixed size: the same digits on every processor and for any number of threads.
#pragma once

#include "src/base/types.hpp"

namespace rockfold::host {

/// c −= a bᵀ with a [rows × depth], b [columns × depth] and c [rows × columns], whose columns are `a_stride`, … entries apart.
void take_off_product(Index rows, Index columns, Index depth, const Real* a, Index a_stride,
                      const Real* b, Index b_stride, Real* c, Index c_stride);

/// The lower half of c −= a aᵀ with a [n × depth] and c [n × n], on all threads. Some of the upper half changes too.
void take_off_square(Index n, Index depth, const Real* a, Index a_stride, Real* c, Index c_stride);

/// b ← b L⁻ᵀ with b [rows × n] and the lower half L [n × n], on all threads.
void divide_by_transpose(Index rows, Index n, const Real* lower, Index lower_stride, Real* b,
                         Index b_stride);

}  // namespace rockfold::host
