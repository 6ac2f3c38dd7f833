// SPDX-License-Identifier: Apache-2.0
/* One channel of the stream: its batches in order, where to begin, and the compensation of it. */
#ifndef LANE_H
#define LANE_H

#include <stdint.h>

#include "compensation.h"
#include "stream.h"

#define STAGE trunnion_stream_COMPENSATION
enum { BATCHES = 1024, MAXIMUM_STATES = 8 };

struct lane {
  trunnion_stream_AxisBatch batches[BATCHES]; /* by first cycle; a batch has a `count` when it is there */
  uint32_t epoch, newest_epoch, start_epoch;
  uint64_t next, newest, start;
  int in_step, settled, has_start;
  double gap_since;
  struct compensation core;
  uint64_t revision; /* the core is configured with, 0 = none */
  double cut[MAXIMUM_AXES * STATE_PER_AXIS]; /* state to go on from */
  size_t cut_length;
  int has_cut;
  double told_at; /* of its progress */
  uint64_t told_next;
  int told_in_step;
};

/* Takes `batch` by exchanging it with an old one; what is void or known is left. */
void lane_put(struct lane *l, trunnion_stream_AxisBatch *batch);
/* The batch to compute next, or NULL. */
const trunnion_stream_AxisBatch *lane_peek(struct lane *l);
/* Goes on from the consistent cut that the drive echoes, once the batch behind it is here. */
void lane_join(struct lane *l, const trunnion_stream_ChannelEcho *echo);
/* A later batch is here while the next one is missing. */
int lane_gap(struct lane *l);

const trunnion_stream_StageState *find_state(const dds_sequence_trunnion_stream_StageState *states,
                                             trunnion_stream_Stage stage);

#endif
