// SPDX-License-Identifier: Apache-2.0
// What an alarm says, in the language of the operator; behind it, in English, the names and numbers of the service.
import { wording } from "../state/alarms";
import { text } from "../text/texts";

interface Props {
  alarm: Parameters<typeof wording>[0];
}

export function AlarmWords({ alarm }: Props) {
  const says = wording(alarm, text.value);
  return (
    <>
      {says.text}
      {says.detail && <span class="alarm-detail" lang="en"> {says.detail}</span>}
    </>
  );
}
