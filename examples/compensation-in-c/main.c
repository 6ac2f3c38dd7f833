// SPDX-License-Identifier: Apache-2.0
/* The stage `compensation` of the stream in plain C: kinematics' batches in, compensated batches out. */
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <time.h>
#include <unistd.h>

#include "cluster.h"
#include "contract.h"
#include "lane.h"

enum { LANES = 10, LEAD = 900, ALARM_REVISION_UNKNOWN = 104 };

struct service {
  struct options options;
  struct cluster cluster;
  trunnion_parameters_ParameterSet incoming, newest, previous;
  trunnion_stream_Feedback feedback;
  trunnion_stream_AxisBatch spare, out;
  trunnion_stream_StageState states[MAXIMUM_STATES];
  double own_state[MAXIMUM_AXES * STATE_PER_AXIS], setpoints[2048];
  struct lane lanes[LANES];
  int used[LANES], have_feedback, standby;
  uint64_t messages_in, messages_out, cycles_lost, beats, lead;
  double started, beaten_at, unknown_since;
  uint64_t messages_beaten;
  int last_active;
};

static volatile sig_atomic_t stop_requested;
static void on_signal(int number) {
  (void)number;
  stop_requested = 1;
}

static double now_seconds(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int usage(const char *what) {
  fprintf(stderr, "compensation-in-c: %s\nOptions as of every service: --machine --state --instance --replica --channel "
                  "--domain --vendor --interface --peers --multicast --virtual-time --parent-bound --standby\n", what);
  return 1;
}

static int parse(struct options *o, int argc, char **argv) {
  for (int i = 1; i < argc; ++i) {
    const char *name = argv[i];
    const char *value = i + 1 < argc ? argv[i + 1] : NULL;
    if (strcmp(name, "--virtual-time") == 0) {
      o->virtual_time = 1;
    } else if (strcmp(name, "--parent-bound") == 0) {
      o->parent_bound = 1;
    } else if (strcmp(name, "--standby") == 0) {
      o->standby = 1;
    } else if (strcmp(name, "--multicast") == 0) {
      o->multicast = 1;
    } else if (value == NULL) {
      return usage(name);
    } else if (strcmp(name, "--security") == 0) {
      return usage("it has no certificate to show");
    } else if (strcmp(name, "--vendor") == 0 && strcmp(value, "cyclonedds") != 0) {
      return usage("it speaks Cyclone DDS only");
    } else {
      if (strcmp(name, "--instance") == 0)
        o->instance = (unsigned)strtoul(value, NULL, 10);
      else if (strcmp(name, "--replica") == 0)
        o->replica = (unsigned)strtoul(value, NULL, 10);
      else if (strcmp(name, "--domain") == 0)
        o->domain = (unsigned)strtoul(value, NULL, 10);
      else if (strcmp(name, "--interface") == 0)
        o->interface_address = value;
      else if (strcmp(name, "--peers") == 0)
        o->peers = value;
      if (strncmp(value, "--", 2) != 0) ++i; /* also of an option that a later version gives */
    }
  }
  return 0;
}

static const trunnion_parameters_ParameterSet *find_revision(const struct service *s, uint64_t revision) {
  if (s->newest.revision == revision) return &s->newest;
  return s->previous.revision == revision ? &s->previous : NULL;
}

static void raise_unknown_revision(const struct service *s, uint16_t channel, uint64_t revision) {
  trunnion_service_Alarm alarm;
  memset(&alarm, 0, sizeof alarm);
  alarm.instance = s->options.instance, alarm.number = ALARM_REVISION_UNKNOWN, alarm.part = channel;
  alarm.active = true, alarm.severity = trunnion_service_ERROR, alarm.reaction = trunnion_service_AXIS_STOP;
  strcpy(alarm.source, "compensation");
  snprintf(alarm.text, sizeof alarm.text, "Batches are made with parameter revision %llu, which has not arrived",
           (unsigned long long)revision);
  alarm.occurrences = 1;
  if (!s->standby) dds_write(s->cluster.alarm, &alarm);
}

/* The core is configured with the revision of the batch; its state survives that. 0 when it must wait. */
static int use_revision(struct service *s, struct lane *l, uint16_t channel, uint64_t revision) {
  double kept[MAXIMUM_AXES * STATE_PER_AXIS];
  const trunnion_parameters_ParameterSet *set = find_revision(s, revision);
  size_t length;
  if (l->revision == revision) return 1;
  if (set == NULL) {
    const double now = now_seconds();
    if (s->unknown_since == 0) s->unknown_since = now;
    if (now - s->unknown_since > 1) {
      raise_unknown_revision(s, channel, revision);
      s->unknown_since = now;
    }
    return 0;
  }
  s->unknown_since = 0;
  length = l->has_cut ? l->cut_length : compensation_save(&l->core, kept);
  if (l->has_cut) memcpy(kept, l->cut, sizeof kept);
  if (compensation_configure(&l->core, set, channel) != 0) return 0;
  compensation_load(&l->core, kept, length);
  l->has_cut = 0;
  l->revision = revision;
  return 1;
}

/* The states that came with the input, and this stage's in the place it has or behind them. */
static void fill_states(struct service *s, const trunnion_stream_AxisBatch *in, const struct lane *l) {
  uint32_t count = in->states._length < MAXIMUM_STATES - 1 ? in->states._length : MAXIMUM_STATES - 1;
  uint32_t own = count;
  for (uint32_t i = 0; i < count; ++i) {
    s->states[i] = in->states._buffer[i];
    if (s->states[i].stage == STAGE) own = i;
  }
  if (own == count) ++count;
  memset(&s->states[own], 0, sizeof s->states[own]);
  s->states[own].stage = STAGE;
  s->states[own].cycle = in->first + in->count - 1;
  s->states[own].values._buffer = s->own_state;
  s->states[own].values._length = s->states[own].values._maximum =
      (uint32_t)compensation_save(&l->core, s->own_state);
  s->out.states._buffer = s->states;
  s->out.states._length = s->out.states._maximum = count;
}

static void run_lane(struct service *s, uint16_t channel) {
  struct lane *l = &s->lanes[channel];
  const trunnion_stream_AxisBatch *in;
  (void)lane_peek(l); /* a start that is here takes it into step */
  for (uint32_t i = 0; !l->in_step && i < s->feedback.channels._length; ++i)
    if (s->feedback.channels._buffer[i].channel == channel) lane_join(l, &s->feedback.channels._buffer[i]);
  while ((in = lane_peek(l)) != NULL) {
    trunnion_stream_AxisBatch *out = &s->out;
    const size_t columns = in->axes._length;
    if (!use_revision(s, l, channel, in->revision)) return;
    if (in->setpoints._length != in->count * columns || in->setpoints._length > 2048) return;
    if (in->starts) {
      const trunnion_stream_StageState *state = find_state(&in->states, STAGE);
      if (state != NULL) compensation_load(&l->core, state->values._buffer, state->values._length);
    }
    memcpy(s->setpoints, in->setpoints._buffer, in->setpoints._length * sizeof(double));
    compensation_process(&l->core, in->setpoints._buffer, s->setpoints, in->count, columns);
    *out = *in; /* shares the input's axes and lines, which live in the lane until they are overwritten */
    out->stage = STAGE;
    out->replica = (uint8_t)s->options.replica;
    out->setpoints._buffer = s->setpoints;
    fill_states(s, in, l);
    dds_write(s->cluster.output, out);
    ++s->messages_out;
    l->next = in->first + in->count;
    l->gap_since = 0;
  }
  if (l->in_step && lane_gap(l)) {
    const double now = now_seconds();
    if (l->gap_since == 0) l->gap_since = now;
    if (now - l->gap_since > 0.02) { /* it will not come any more: go on from the cut */
      ++s->cycles_lost;
      l->in_step = l->settled = 0;
      l->gap_since = 0;
    }
  }
}

static void report_progress(struct service *s, uint16_t channel) {
  struct lane *l = &s->lanes[channel];
  trunnion_stream_StageProgress p;
  const double now = now_seconds();
  if (l->in_step && !l->settled) l->settled = lane_peek(l) == NULL && cluster_matched(s->cluster.output) > 0;
  if (s->standby) return;
  memset(&p, 0, sizeof p);
  p.stage = STAGE, p.replica = (uint8_t)s->options.replica, p.channel = channel;
  p.in_step = l->in_step && l->settled, p.epoch = l->epoch, p.next = l->next;
  if (p.in_step == l->told_in_step && p.next < l->told_next + s->lead && now - l->told_at <= 0.1) return;
  l->told_at = now, l->told_in_step = p.in_step, l->told_next = p.next;
  dds_write(s->cluster.progress, &p);
}

static void beat(struct service *s) {
  trunnion_service_ServiceState state;
  const double now = now_seconds();
  const int active = s->cluster.output > 0 && s->have_feedback && !s->standby;
  if (now - s->beaten_at < 0.25 && active == s->last_active) return;
  memset(&state, 0, sizeof state);
  state.instance = s->options.instance;
  strcpy(state.service, "compensation");
  strcpy(state.vendor, "cyclonedds");
  state.pid = getpid(), state.replica = (uint8_t)s->options.replica;
  state.lifecycle = active                  ? trunnion_service_ACTIVE
                    : s->cluster.output > 0 ? trunnion_service_INACTIVE
                                            : trunnion_service_UNCONFIGURED;
  strcpy(state.detail, s->cluster.output <= 0 ? "waiting for parameters"
                       : !s->have_feedback    ? "waiting for the drive"
                                              : "");
  state.beats = ++s->beats, state.uptime = now - s->started;
  state.messages_in = s->messages_in, state.messages_out = s->messages_out, state.cycles_lost = s->cycles_lost;
  state.messages_per_second = s->beaten_at > 0 ? (double)(s->messages_out - s->messages_beaten) / (now - s->beaten_at) : 0;
  state.revision = s->newest.revision;
  state.in_step = !s->standby || (s->cluster.output > 0 && s->have_feedback);
  for (int c = 0; c < LANES; ++c)
    if (s->used[c]) state.in_step = state.in_step && s->lanes[c].in_step && s->lanes[c].settled;
  state.standby = !s->standby    ? trunnion_service_TAKES_PART
                  : state.in_step ? trunnion_service_MATCHING
                                  : trunnion_service_JOINING;
  dds_write(s->cluster.state, &state);
  s->beaten_at = now, s->messages_beaten = s->messages_out, s->last_active = active;
}

static void take_parameters(struct service *s) {
  while (cluster_take(s->cluster.parameters, &s->incoming)) {
    const trunnion_parameters_ParameterSet oldest = s->previous;
    if (s->incoming.revision == s->newest.revision) continue;
    s->previous = s->newest;
    s->newest = s->incoming;
    s->incoming = oldest; /* its memory is used again */
  }
}

static int promoted(struct service *s) {
  trunnion_service_Promotion promotion;
  int found = 0;
  while (cluster_take(s->cluster.promotions, &promotion))
    found = found || (promotion.instance == s->options.instance && promotion.pid == getpid());
  return found;
}

static int pump(struct service *s) {
  take_parameters(s);
  if (s->newest.revision == 0) return 0;
  if (s->cluster.output == 0) {
    s->lead = 32;
    for (uint32_t i = 0; i < s->newest.values._length; ++i)
      if (s->newest.values._buffer[i].number == LEAD) s->lead = (uint64_t)s->newest.values._buffer[i].value;
    if (cluster_open_output(&s->cluster, s->standby) != 0) return -1;
  }
  if (s->standby && promoted(s)) {
    s->standby = 0;
    for (int c = 0; c < LANES; ++c) s->lanes[c].settled = 0;
    if (cluster_open_output(&s->cluster, 0) != 0) return -1;
  }
  while (cluster_take(s->cluster.feedback, &s->feedback)) {
    s->have_feedback = 1;
    for (uint32_t i = 0; i < s->feedback.channels._length; ++i)
      if (s->feedback.channels._buffer[i].channel < LANES) s->used[s->feedback.channels._buffer[i].channel] = 1;
  }
  while (cluster_take(s->cluster.input, &s->spare)) {
    ++s->messages_in;
    if (s->spare.channel >= LANES) continue;
    s->used[s->spare.channel] = 1;
    lane_put(&s->lanes[s->spare.channel], &s->spare);
  }
  for (uint16_t c = 0; c < LANES; ++c)
    if (s->used[c]) {
      run_lane(s, c);
      report_progress(s, c);
    }
  return 0;
}

int main(int argc, char **argv) {
  static struct service s; /* the lanes are large */
  struct sigaction action;
  int status = 0;
  s.options.interface_address = s.options.peers = "127.0.0.1";
  if (parse(&s.options, argc, argv) != 0) return 1;
  memset(&action, 0, sizeof action);
  action.sa_handler = on_signal;
  sigaction(SIGTERM, &action, NULL);
  sigaction(SIGINT, &action, NULL);
  if (s.options.parent_bound) prctl(PR_SET_PDEATHSIG, SIGTERM);
  s.started = now_seconds();
  s.standby = s.options.standby;
  s.last_active = -1;
  if (cluster_open(&s.cluster, &s.options) != 0) return 1;
  cluster_announce(&s.cluster, &s.options);
  while (!stop_requested && status == 0) {
    cluster_wait(&s.cluster, 20);
    status = pump(&s);
    beat(&s);
  }
  cluster_close(&s.cluster);
  return status == 0 ? 0 : 1;
}
