// SPDX-License-Identifier: Apache-2.0
#include "lane.h"

#include <string.h>

static int before(uint32_t epoch_a, uint64_t cycle_a, uint32_t epoch_b, uint64_t cycle_b) {
  return epoch_a < epoch_b || (epoch_a == epoch_b && cycle_a < cycle_b);
}

const trunnion_stream_StageState *find_state(const dds_sequence_trunnion_stream_StageState *states,
                                             trunnion_stream_Stage stage) {
  for (uint32_t i = 0; i < states->_length; ++i)
    if (states->_buffer[i].stage == stage) return &states->_buffer[i];
  return NULL;
}

void lane_put(struct lane *l, trunnion_stream_AxisBatch *batch) {
  trunnion_stream_AxisBatch *slot = &l->batches[batch->first % BATCHES];
  trunnion_stream_AxisBatch old;
  if (batch->count == 0 || batch->epoch < l->epoch) return;
  if (batch->epoch == l->epoch && batch->first + batch->count <= l->next && !batch->starts) return;
  if (slot->count != 0 && slot->epoch == batch->epoch && slot->first == batch->first) return;
  /* The history of a writer that matches late replaces nothing that is still to be taken. */
  if (slot->count != 0 && before(batch->epoch, batch->first, slot->epoch, slot->first)) return;
  if (batch->starts && before(l->start_epoch, l->start, batch->epoch, batch->first)) {
    l->start_epoch = batch->epoch;
    l->start = batch->first;
    l->has_start = 1;
  }
  if (before(l->newest_epoch, l->newest, batch->epoch, batch->first)) {
    l->newest_epoch = batch->epoch;
    l->newest = batch->first;
  }
  old = *slot;
  *slot = *batch;
  *batch = old;
}

static const trunnion_stream_AxisBatch *next_batch(const struct lane *l) {
  const trunnion_stream_AxisBatch *slot = &l->batches[l->next % BATCHES];
  return slot->count != 0 && slot->epoch == l->epoch && slot->first == l->next ? slot : NULL;
}

const trunnion_stream_AxisBatch *lane_peek(struct lane *l) {
  if (l->has_start && !before(l->start_epoch, l->start, l->epoch, l->next)) {
    l->epoch = l->start_epoch;
    l->next = l->start;
    l->has_start = 0;
    l->in_step = 1;
  }
  return l->in_step ? next_batch(l) : NULL;
}

int lane_gap(struct lane *l) {
  return before(l->epoch, l->next, l->newest_epoch, l->newest) && next_batch(l) == NULL;
}

void lane_join(struct lane *l, const trunnion_stream_ChannelEcho *echo) {
  const trunnion_stream_StageState *state = find_state(&echo->states, STAGE);
  if (!echo->active) { /* nothing moves: the first batch of the next motion carries the state */
    l->epoch = echo->epoch;
    l->next = echo->next;
    l->in_step = 1;
    return;
  }
  if (state == NULL || state->values._length > sizeof l->cut / sizeof l->cut[0]) return;
  l->epoch = echo->epoch;
  l->next = state->cycle + 1;
  if (next_batch(l) == NULL) return;
  l->cut_length = state->values._length;
  if (l->cut_length > 0) memcpy(l->cut, state->values._buffer, l->cut_length * sizeof l->cut[0]);
  l->has_cut = 1;
  l->revision = 0;
  l->in_step = 1;
}
