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

void lane_put(struct lane *l, trunnion_stream_AxisFrame *frame) {
  trunnion_stream_AxisFrame *slot = &l->frames[frame->first % FRAMES];
  trunnion_stream_AxisFrame old;
  if (frame->count == 0 || frame->epoch < l->epoch) return;
  if (frame->epoch == l->epoch && frame->first + frame->count <= l->next && !frame->starts) return;
  if (slot->count != 0 && slot->epoch == frame->epoch && slot->first == frame->first) return;
  /* The history of a writer that matches late replaces nothing that is still to be taken. */
  if (slot->count != 0 && before(frame->epoch, frame->first, slot->epoch, slot->first)) return;
  if (frame->starts && before(l->start_epoch, l->start, frame->epoch, frame->first)) {
    l->start_epoch = frame->epoch;
    l->start = frame->first;
    l->has_start = 1;
  }
  if (before(l->newest_epoch, l->newest, frame->epoch, frame->first)) {
    l->newest_epoch = frame->epoch;
    l->newest = frame->first;
  }
  old = *slot;
  *slot = *frame;
  *frame = old;
}

static const trunnion_stream_AxisFrame *next_frame(const struct lane *l) {
  const trunnion_stream_AxisFrame *slot = &l->frames[l->next % FRAMES];
  return slot->count != 0 && slot->epoch == l->epoch && slot->first == l->next ? slot : NULL;
}

const trunnion_stream_AxisFrame *lane_peek(struct lane *l) {
  if (l->has_start && !before(l->start_epoch, l->start, l->epoch, l->next)) {
    l->epoch = l->start_epoch;
    l->next = l->start;
    l->has_start = 0;
    l->in_step = 1;
  }
  return l->in_step ? next_frame(l) : NULL;
}

int lane_gap(struct lane *l) {
  return before(l->epoch, l->next, l->newest_epoch, l->newest) && next_frame(l) == NULL;
}

void lane_join(struct lane *l, const trunnion_stream_ChannelEcho *echo) {
  const trunnion_stream_StageState *state = find_state(&echo->states, STAGE);
  if (!echo->active) { /* nothing moves: the first frame of the next motion carries the state */
    l->epoch = echo->epoch;
    l->next = echo->next;
    l->in_step = 1;
    return;
  }
  if (state == NULL || state->values._length > sizeof l->cut / sizeof l->cut[0]) return;
  l->epoch = echo->epoch;
  l->next = state->cycle + 1;
  if (next_frame(l) == NULL) return;
  l->cut_length = state->values._length;
  if (l->cut_length > 0) memcpy(l->cut, state->values._buffer, l->cut_length * sizeof l->cut[0]);
  l->has_cut = 1;
  l->revision = 0;
  l->in_step = 1;
}
