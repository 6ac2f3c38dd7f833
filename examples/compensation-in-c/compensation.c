// SPDX-License-Identifier: Apache-2.0
#include "compensation.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { channel_class = 40000, compensation_class = 300000, unit = 1000, first_channel_axis = 1 };

/* The set holds, ascending by number, the values that differ from the catalogue's defaults. */
static double value_of(const trunnion_parameters_ParameterSet *set, unsigned number, double otherwise) {
  size_t low = 0, high = set->values._length;
  while (low < high) {
    const size_t middle = (low + high) / 2;
    if (set->values._buffer[middle].number < number)
      low = middle + 1;
    else
      high = middle;
  }
  return low < set->values._length && set->values._buffer[low].number == number ? set->values._buffer[low].value
                                                                                : otherwise;
}

static double *read_table(const trunnion_parameters_ParameterSet *set, unsigned first, size_t points) {
  double *table = malloc(points * sizeof *table);
  for (size_t i = 0; table != NULL && i < points; ++i) table[i] = value_of(set, first + (unsigned)i, 0);
  return table;
}

static int configure_axis(struct axis *a, const trunnion_parameters_ParameterSet *set, unsigned number) {
  const unsigned base = compensation_class + number * unit;
  const int pitch_type = (int)value_of(set, base + 20, 0);
  const int points = (int)value_of(set, base + 22, 0);
  const unsigned table = (unsigned)value_of(set, base + 26, 700000);
  struct pitch_table *p = &a->pitch;
  memset(a, 0, sizeof *a);
  a->backlash = (int)value_of(set, base, 0) == 1 ? value_of(set, base + 1, 0) : 0;
  a->rate = value_of(set, base + 2, 0.01);
  p->enabled = pitch_type != 0 && points > 0;
  p->bidirectional = pitch_type == 2;
  p->start = value_of(set, base + 21, 0);
  p->interval = value_of(set, base + 23, 1);
  p->modulo = (int)value_of(set, base + 24, 0) == 1;
  p->factor = value_of(set, base + 25, 1);
  if (!p->enabled) return 0;
  p->points = (size_t)points;
  p->positive = read_table(set, table, p->points);
  if (p->positive == NULL) return -1;
  if (!p->bidirectional) return 0;
  p->negative = read_table(set, table + (unsigned)points, p->points);
  return p->negative == NULL ? -1 : 0;
}

void compensation_free(struct compensation *c) {
  for (size_t i = 0; i < c->count; ++i) {
    free(c->axes[i].pitch.positive);
    free(c->axes[i].pitch.negative);
  }
  memset(c, 0, sizeof *c);
}

int compensation_configure(struct compensation *c, const trunnion_parameters_ParameterSet *set,
                           unsigned channel) {
  compensation_free(c);
  for (unsigned i = 0; i < MAXIMUM_AXES; ++i) {
    const int number = (int)value_of(set, channel_class + channel * unit + first_channel_axis + i, -1);
    if (number < 0) continue;
    if (configure_axis(&c->axes[c->count++], set, (unsigned)number) != 0) return -1;
  }
  return 0;
}

static double pitch_at(const struct pitch_table *p, double x, int positive_direction) {
  const double *table = p->bidirectional && !positive_direction ? p->negative : p->positive;
  double place = (x - p->start) / p->interval;
  const double n = (double)p->points;
  size_t i;
  if (!p->enabled) return 0;
  if (p->modulo) {
    place -= floor(place / n) * n;
    i = (size_t)place < p->points - 1 ? (size_t)place : p->points - 1;
    return p->factor * (table[i] + (table[(i + 1) % p->points] - table[i]) * (place - (double)i));
  }
  if (place <= 0) return p->factor * table[0];
  if (place >= n - 1) return p->factor * table[p->points - 1];
  i = (size_t)place;
  return p->factor * (table[i] + (table[i + 1] - table[i]) * (place - (double)i));
}

static double clamp(double value, double low, double high) {
  return value < low ? low : high < value ? high : value;
}

static double compensate(struct axis *a, double x, int primed) {
  if (!primed) a->last = x;
  const double rounding = 1e-9; /* mm or deg: no reversal */
  if (fabs(x - a->last) > rounding) {
    a->direction = x > a->last ? 1 : -1;
    a->last = x;
  }
  const double wanted = a->direction < 0 ? -a->backlash : 0;
  a->added += clamp(wanted - a->added, -a->rate, a->rate);
  return x + a->added + pitch_at(&a->pitch, x, a->direction >= 0);
}

void compensation_process(struct compensation *c, const double *in, double *out, size_t rows, size_t columns) {
  const size_t width = columns < c->count ? columns : c->count;
  if (width == 0) return;
  for (size_t row = 0; row < rows; ++row) {
    for (size_t i = 0; i < width; ++i)
      out[row * columns + i] = compensate(&c->axes[i], in[row * columns + i], c->primed);
    c->primed = 1;
  }
}

void compensation_load(struct compensation *c, const double *values, size_t length) {
  c->primed = length != 0 && length == STATE_PER_AXIS * c->count;
  for (size_t i = 0; i < c->count; ++i) {
    const double *own = values + STATE_PER_AXIS * i;
    c->axes[i].last = c->primed ? own[0] : 0;
    c->axes[i].direction = c->primed ? own[1] : 0;
    c->axes[i].added = c->primed ? own[2] : 0;
  }
}

size_t compensation_save(const struct compensation *c, double *values) {
  if (!c->primed) return 0;
  for (size_t i = 0; i < c->count; ++i) {
    values[STATE_PER_AXIS * i] = c->axes[i].last;
    values[STATE_PER_AXIS * i + 1] = c->axes[i].direction;
    values[STATE_PER_AXIS * i + 2] = c->axes[i].added;
  }
  return STATE_PER_AXIS * c->count;
}
