// SPDX-License-Identifier: Apache-2.0

/**
 * For what stops: acts when the finger or the mouse key goes down, not when it comes up. A click without a pointer
 * is that of a keyboard or a screen reader.
 */
export const onPress = (act: () => void) => ({
  onPointerDown: (event: PointerEvent) => {
    if (event.button === 0) act();
  },
  onClick: (event: MouseEvent) => {
    if (event.detail === 0) act();
  },
});
