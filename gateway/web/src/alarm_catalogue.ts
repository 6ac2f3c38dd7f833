// SPDX-License-Identifier: Apache-2.0
// Generated from libs/machine/machine/alarms.yaml and its translations by tools/generate_docs.py.

/** What an alarm says, its usual cause and what the operator does, by its number and the language. */
export const alarmCatalogue: Readonly<Record<number, Readonly<Record<string, { text: string; cause: string; remedy: string }>>>> = {
  100: {
    en: { text: "A service has ended or does not respond", cause: "The process has ended, was killed or is blocked, or its host or network is lost", remedy: "Wait for the restart by the launcher, then reset the alarm; if it comes back, read the service's line in Diagnosis and its log; when the hosts of a secured machine stay apart although the network is whole, run trunnion down and trunnion up on every host" },
    zh: { text: "某个服务已结束或没有应答", cause: "进程已结束、被终止或被阻塞，或其主机或网络中断", remedy: "等待启动器重新启动该服务，然后复位报警；若再次出现，请查看诊断中该服务的一行及其日志；若网络已恢复而加密机床的各主机仍互不相通，请在每台主机上执行 trunnion down 和 trunnion up" },
    de: { text: "Ein Dienst ist beendet oder antwortet nicht", cause: "Der Prozess ist beendet, wurde abgebrochen oder ist blockiert, oder sein Rechner oder Netz ist ausgefallen", remedy: "Auf den Neustart durch den Launcher warten, dann den Alarm zurücksetzen; kommt er wieder, die Zeile des Dienstes in Diagnose und sein Protokoll lesen; finden die Rechner einer gesicherten Maschine trotz heilem Netz nicht zueinander, auf jedem Rechner trunnion down und trunnion up ausführen" },
  },
  101: {
    en: { text: "A service was built with a different contract", cause: "Services of different versions run in one cluster", remedy: "Install one version on every host, or replace the service by one with the same contract" },
    zh: { text: "某个服务按不同的合约构建", cause: "同一集群中运行着不同版本的服务", remedy: "在所有主机上安装同一版本，或换成合约相同的服务" },
    de: { text: "Ein Dienst wurde mit einem anderen Vertrag gebaut", cause: "Dienste verschiedener Versionen laufen in einem Cluster", remedy: "Auf allen Rechnern dieselbe Version installieren, oder den Dienst durch einen mit demselben Vertrag ersetzen" },
  },
  102: {
    en: { text: "A replica of a stage is lost", cause: "One of two replicas has ended, is too slow or has not joined", remedy: "Motion continues with the other replica; the alarm ends when the lost one is in step again" },
    zh: { text: "某一级的一个副本丢失", cause: "两个副本之一已结束、过慢或尚未加入", remedy: "运动由另一个副本继续；缺失的副本重新同步后报警自动结束" },
    de: { text: "Ein Replikat einer Stufe fehlt", cause: "Eines von zwei Replikaten ist beendet, zu langsam oder nicht beigetreten", remedy: "Die Bewegung geht mit dem anderen Replikat weiter; der Alarm endet, wenn das fehlende wieder im Gleichschritt ist" },
  },
  103: {
    en: { text: "Two replicas of a stage computed different setpoints", cause: "A replica computes with a fault: memory, processor or a different program", remedy: "Keep a recording, check the versions of both replicas in Diagnosis, restart the service that differs, then reset" },
    zh: { text: "同一级的两个副本算出不同的设定值", cause: "某个副本计算有误：内存、处理器或程序不同", remedy: "保留记录，在诊断中核对两个副本的版本，重新启动不一致的服务，然后复位" },
    de: { text: "Zwei Replikate einer Stufe haben verschiedene Sollwerte berechnet", cause: "Ein Replikat rechnet fehlerhaft: Speicher, Prozessor oder ein anderes Programm", remedy: "Eine Aufzeichnung aufbewahren, die Versionen beider Replikate in Diagnose vergleichen, den abweichenden Dienst neu starten, dann zurücksetzen" },
  },
  104: {
    en: { text: "Setpoints require a parameter revision that has not arrived", cause: "The parameters service does not respond or was restarted during a change", remedy: "Check the parameters service in Diagnosis, then reset the channel" },
    zh: { text: "设定值要求的参数版本尚未到达", cause: "参数服务没有应答，或在更改期间重新启动", remedy: "在诊断中检查参数服务，然后复位通道" },
    de: { text: "Sollwerte verlangen einen Parameterstand, der nicht angekommen ist", cause: "Der Dienst parameters antwortet nicht oder wurde während einer Änderung neu gestartet", remedy: "Den Dienst parameters in Diagnose prüfen, dann den Kanal zurücksetzen" },
  },
  105: {
    en: { text: "A service ends repeatedly after its start", cause: "The service finds a fault at every start, for example in its configuration", remedy: "Read the service's line in Diagnosis and its log, correct the cause, then reset the alarm" },
    zh: { text: "某个服务启动后反复结束", cause: "该服务每次启动都发现错误，例如配置有误", remedy: "查看诊断中该服务的一行及其日志，排除原因，然后复位报警" },
    de: { text: "Ein Dienst endet nach seinem Start immer wieder", cause: "Der Dienst findet bei jedem Start einen Fehler, zum Beispiel in seiner Konfiguration", remedy: "Die Zeile des Dienstes in Diagnose und sein Protokoll lesen, die Ursache beheben, dann den Alarm zurücksetzen" },
  },
  106: {
    en: { text: "A service refused messages on the bus", cause: "A process writes a topic with a value that the field cannot have, or of another format; nothing of such a message takes effect", remedy: "The alarm names the topic and its writer, as far as its process publishes where it is: end the process on its host (`ss -ulpn` shows the process of a port), or give the machine another domain; docs/topics.md has the writers that belong to a machine; use a secured cluster on a network" },
    zh: { text: "某个服务拒绝了总线上的消息", cause: "某个进程向主题写入了字段不可能有的值，或格式不同；这样的消息不会生效", remedy: "报警给出主题以及写入者（以该进程公布的信息为限）：在其主机上结束该进程（`ss -ulpn` 显示端口所属的进程），或为机床设置另一个域；docs/topics.md 列出机床的写入者；在网络上使用加密的集群" },
    de: { text: "Ein Dienst hat Nachrichten auf dem Bus abgelehnt", cause: "Ein Prozess schreibt ein Topic mit einem Wert, den das Feld nicht haben kann, oder in einem anderen Format; von einer solchen Nachricht wird nichts wirksam", remedy: "Der Alarm nennt das Topic und den Schreiber, soweit dessen Prozess sich zu erkennen gibt: den Prozess auf seinem Rechner beenden (`ss -ulpn` zeigt den Prozess zu einem Port), oder der Maschine eine andere Domäne geben; docs/topics.md nennt die Schreiber einer Maschine; im Netz ein gesichertes Cluster verwenden" },
  },
  107: {
    en: { text: "A host was started with a different machine.yaml", cause: "The files of the machine differ between the hosts", remedy: "Copy the same machine directory to every host and start the cluster again" },
    zh: { text: "某台主机以不同的 machine.yaml 启动", cause: "各主机上的机床文件不一致", remedy: "将同一机床目录复制到所有主机，然后重新启动集群" },
    de: { text: "Ein Rechner wurde mit einer anderen machine.yaml gestartet", cause: "Die Dateien der Maschine sind auf den Rechnern verschieden", remedy: "Dasselbe Maschinenverzeichnis auf alle Rechner kopieren und das Cluster neu starten" },
  },
  108: {
    en: { text: "A request to swap a service was refused", cause: "The request came from another user, or for an executable outside the permitted directories", remedy: "Find out who sent it (swaps.jsonl); add the directory to swap_directories in machine.yaml if it is permitted" },
    zh: { text: "更换服务的请求被拒绝", cause: "请求来自其他用户，或可执行文件不在允许的目录中", remedy: "查明发送者（swaps.jsonl）；若允许，将该目录加入 machine.yaml 的 swap_directories" },
    de: { text: "Der Tausch eines Dienstes wurde abgelehnt", cause: "Die Anforderung kam von einem anderen Benutzer oder für ein Programm außerhalb der erlaubten Verzeichnisse", remedy: "Den Absender feststellen (swaps.jsonl); das Verzeichnis in swap_directories von machine.yaml eintragen, wenn es erlaubt ist" },
  },
  109: {
    en: { text: "Another launcher runs in the DDS domain of this machine", cause: "Two clusters use the same DDS domain", remedy: "Stop one of them, or give one another domain" },
    zh: { text: "另一个启动器运行在本机床的 DDS 域中", cause: "两个集群使用同一个 DDS 域", remedy: "停止其中一个，或为其设置另一个域" },
    de: { text: "Ein anderer Launcher läuft in der DDS-Domain dieser Maschine", cause: "Zwei Cluster benutzen dieselbe DDS-Domain", remedy: "Eines davon anhalten oder ihm eine andere Domain geben" },
  },
  110: {
    en: { text: "A setpoint did not arrive in time", cause: "A service of the stream or its computer is too slow, or has ended", remedy: "Press cycle start: the path continues where it stopped; if it comes back, check the load of the computer and raise parameter 000900" },
    zh: { text: "设定值没有及时到达", cause: "数据流中的某个服务或其计算机过慢，或已结束", remedy: "按循环启动：从停止处沿轨迹继续；若再次出现，检查计算机负载并增大参数 000900" },
    de: { text: "Ein Sollwert kam nicht rechtzeitig an", cause: "Ein Dienst des Datenstroms oder sein Rechner ist zu langsam oder ausgefallen", remedy: "Zyklusstart drücken: die Bahn geht dort weiter, wo sie angehalten hat; kommt der Alarm wieder, die Auslastung des Rechners prüfen und Parameter 000900 erhöhen" },
  },
  111: {
    en: { text: "The following error exceeds its limit", cause: "The axis is blocked, overloaded or badly tuned, or its limit is too small", remedy: "Look for a collision or a hard-moving axis; then reset, and check the drive and the axis' limit of the following error" },
    zh: { text: "跟随误差超过限值", cause: "轴被卡住、过载或调整不当，或限值过小", remedy: "检查是否碰撞或轴运动不畅；然后复位，并检查驱动器和该轴的跟随误差限值" },
    de: { text: "Der Schleppfehler überschreitet seine Grenze", cause: "Die Achse ist blockiert, überlastet oder schlecht eingestellt, oder die Grenze ist zu klein", remedy: "Nach einer Kollision oder Schwergängigkeit suchen; dann zurücksetzen und den Antrieb und die Grenze des Schleppfehlers prüfen" },
  },
  112: {
    en: { text: "An axis exceeds its software travel limit", cause: "The axis was moved or started beyond its travel", remedy: "Reset the alarm and jog the axis back into its travel" },
    zh: { text: "轴超过软件行程限位", cause: "轴移动到行程之外，或在行程之外启动", remedy: "复位报警，手动将轴移回行程之内" },
    de: { text: "Eine Achse überschreitet ihre Software-Endlage", cause: "Die Achse wurde über ihren Verfahrbereich hinaus bewegt oder dort gestartet", remedy: "Den Alarm zurücksetzen und die Achse von Hand in ihren Verfahrbereich fahren" },
  },
  113: {
    en: { text: "A setpoint step exceeds the maximum velocity of its axis", cause: "A stage computed a jump of a position", remedy: "Do not move the axis; keep a recording, check compensation and kinematic parameters, then reset and reference the axis" },
    zh: { text: "设定值跳变超过该轴的最大速度", cause: "某一级计算出位置突变", remedy: "不要移动该轴；保留记录，检查补偿参数和运动学参数，然后复位并使该轴回参考点" },
    de: { text: "Ein Sollwertsprung überschreitet die Höchstgeschwindigkeit seiner Achse", cause: "Eine Stufe hat einen Sprung der Position berechnet", remedy: "Die Achse nicht bewegen; eine Aufzeichnung aufbewahren, Kompensations- und Kinematikparameter prüfen, dann zurücksetzen und die Achse referenzieren" },
  },
  114: {
    en: { text: "The hardware switched a drive off", cause: "The drive reports a fault of its own or was switched off", remedy: "Read the drive's display, remove the fault, then reset" },
    zh: { text: "硬件切断了某个驱动器", cause: "驱动器报告自身故障，或被断电", remedy: "查看驱动器显示，排除故障，然后复位" },
    de: { text: "Die Hardware hat einen Antrieb abgeschaltet", cause: "Der Antrieb meldet einen eigenen Fehler oder wurde ausgeschaltet", remedy: "Die Anzeige des Antriebs lesen, den Fehler beheben, dann zurücksetzen" },
  },
  115: {
    en: { text: "An axis has no reference", cause: "The position of the axis is not certain after switching on or after damage of its file", remedy: "Do the reference return of the axis in mode REF" },
    zh: { text: "轴没有参考点", cause: "上电后或其文件损坏后，轴的位置不确定", remedy: "在 REF 方式下使该轴回参考点" },
    de: { text: "Eine Achse hat keine Referenz", cause: "Die Position der Achse ist nach dem Einschalten oder nach einem Schaden ihrer Datei unsicher", remedy: "Die Referenzfahrt der Achse in der Betriebsart REF ausführen" },
  },
  116: {
    en: { text: "An axis did not find its reference", cause: "The home switch or the index pulse did not come within 1.1 times the travel or within the time for it", remedy: "Check switch, cable and the homing parameters of the axis, then repeat the reference return" },
    zh: { text: "轴没有找到参考点", cause: "在行程的 1.1 倍内或相应时间内没有遇到回零开关或零脉冲", remedy: "检查该轴的开关、电缆和回零参数，然后重新回参考点" },
    de: { text: "Eine Achse hat ihre Referenz nicht gefunden", cause: "Der Referenzschalter oder der Nullimpuls kam nicht innerhalb des 1,1-fachen Verfahrbereichs oder der Zeit dafür", remedy: "Schalter, Kabel und Referenzparameter der Achse prüfen, dann die Referenzfahrt wiederholen" },
  },
  117: {
    en: { text: "The touch probe made contact outside a skip move (G31)", cause: "The probe was switched on and touched something on the way, or its cable is faulty", remedy: "Reset, jog the probe away from the contact in the opposite direction, check its stylus, then measure again" },
    zh: { text: "测头在跳转运动 (G31) 之外接触", cause: "测头接通后在途中碰到物体，或其电缆有故障", remedy: "复位，手动将测头沿反方向离开接触处，检查测针，然后重新测量" },
    de: { text: "Der Messtaster hatte Kontakt außerhalb einer Messbewegung (G31)", cause: "Der Taster war eingeschaltet und hat unterwegs etwas berührt, oder sein Kabel ist defekt", remedy: "Zurücksetzen, den Taster von Hand in Gegenrichtung von der Berührung wegfahren, den Taststift prüfen, dann neu messen" },
  },
  118: {
    en: { text: "Motor encoder and load encoder of an axis differ by more than the limit", cause: "The load encoder is mounted the wrong way round, has a wrong number of pulses or has lost some; or the axis slips", remedy: "Run `trunnion servo encoders` in semi-closed loop, correct sign and pulses (10a931, 10a932), then reset" },
    zh: { text: "轴的电机编码器与负载编码器之差超过限值", cause: "负载编码器装反、脉冲数错误或丢失脉冲；或轴打滑", remedy: "在半闭环下运行 `trunnion servo encoders`，更正符号和脉冲数（10a931、10a932），然后复位" },
    de: { text: "Motorgeber und Lastgeber einer Achse weichen stärker als erlaubt voneinander ab", cause: "Der Lastgeber ist verkehrt herum angebaut, hat eine falsche Impulszahl oder hat Impulse verloren; oder die Achse rutscht", remedy: "Im halbgeschlossenen Kreis `trunnion servo encoders` ausführen, Vorzeichen und Impulse berichtigen (10a931, 10a932), dann zurücksetzen" },
  },
  119: {
    en: { text: "An axis does not follow, and the drives were switched off", cause: "Its encoder is lost or counts the wrong way, its motor has no power or is blocked: the following error was twice its limit, or did not end with the stop", remedy: "Check encoder, cable, direction and brake of the axis; then reset, and home the axis when its encoder was lost" },
    zh: { text: "轴不跟随，驱动器已被切断", cause: "编码器失效或计数方向相反，电机断电或被卡住：跟随误差达到限值的两倍，或停止后仍未消失", remedy: "检查该轴的编码器、电缆、方向和制动器；然后复位，编码器失效过的轴要重新回参考点" },
    de: { text: "Eine Achse folgt nicht; die Antriebe wurden abgeschaltet", cause: "Ihr Messsystem ist ausgefallen oder zählt verkehrt herum, ihr Motor ist stromlos oder blockiert: der Schleppfehler war doppelt so groß wie die Grenze oder endete nicht mit dem Halt", remedy: "Messsystem, Kabel, Richtung und Bremse der Achse prüfen; dann zurücksetzen und die Achse referenzieren, wenn ihr Messsystem ausgefallen war" },
  },
  121: {
    en: { text: "The gantry synchronization error exceeds its limit", cause: "Master and slave of a gantry are too far apart: load, friction, a lost position or a wrong reference coordinate", remedy: "Check the gantry mechanically; take the slave off (slave_off), jog the master until the error is small, couple again, then reset" },
    zh: { text: "龙门轴同步误差超过限值", cause: "龙门主动轴与从动轴相差过大：负载、摩擦、位置丢失或参考坐标错误", remedy: "检查龙门机械部分；脱开从动轴（slave_off），手动移动主动轴直到误差足够小，重新耦合，然后复位" },
    de: { text: "Der Gleichlauffehler der Gantry überschreitet seine Grenze", cause: "Master und Slave einer Gantry sind zu weit auseinander: Last, Reibung, eine verlorene Position oder eine falsche Referenzkoordinate", remedy: "Die Gantry mechanisch prüfen; den Slave abkoppeln (slave_off), den Master von Hand fahren, bis der Fehler klein ist, wieder koppeln, dann zurücksetzen" },
  },
  122: {
    en: { text: "The speeds of gantry master and slave differ by more than their limit", cause: "One side of the gantry is blocked, or its drive is badly tuned", remedy: "Check both sides mechanically, compare their servo parameters, then reset" },
    zh: { text: "龙门主轴与从轴的速度差超过限值", cause: "龙门一侧被卡住，或其驱动器调整不当", remedy: "检查两侧机械部分，比较其伺服参数，然后复位" },
    de: { text: "Die Geschwindigkeiten von Master und Slave der Gantry weichen stärker als erlaubt voneinander ab", cause: "Eine Seite der Gantry ist blockiert, oder ihr Antrieb ist schlecht eingestellt", remedy: "Beide Seiten mechanisch prüfen, ihre Servoparameter vergleichen, dann zurücksetzen" },
  },
  123: {
    en: { text: "The currents of gantry master and slave differ by more than their limit", cause: "The drives work against each other: the sides are not square, or one moves hard", remedy: "Align the slave, check both sides mechanically and the rated currents (10a940), then reset" },
    zh: { text: "龙门主轴与从轴的电流差超过限值", cause: "两个驱动器相互对抗：两侧不垂直，或一侧运动不畅", remedy: "校准从动轴，检查两侧机械部分和额定电流（10a940），然后复位" },
    de: { text: "Die Ströme von Master und Slave der Gantry weichen stärker als erlaubt voneinander ab", cause: "Die Antriebe arbeiten gegeneinander: die Seiten stehen nicht rechtwinklig, oder eine ist schwergängig", remedy: "Den Slave ausrichten, beide Seiten mechanisch und die Nennströme (10a940) prüfen, dann zurücksetzen" },
  },
  130: {
    en: { text: "The emergency stop is active", cause: "An emergency stop was pressed on the machine, the page or by the PLC", remedy: "Remove the danger, release the emergency stop, then reset; no axis moves by it" },
    zh: { text: "急停有效", cause: "机床、页面或 PLC 触发了急停", remedy: "排除危险，释放急停，然后复位；此过程中轴不会运动" },
    de: { text: "Der Not-Halt ist wirksam", cause: "An der Maschine, auf der Seite oder durch die SPS wurde Not-Halt ausgelöst", remedy: "Die Gefahr beseitigen, den Not-Halt freigeben, dann zurücksetzen; dabei bewegt sich keine Achse" },
  },
  131: {
    en: { text: "The PLC program has an error", cause: "The logic of the machine has a fault: an endless loop, a division by zero or an index outside its array", remedy: "Correct the PLC program at the place in the text and start it again" },
    zh: { text: "PLC 程序有错误", cause: "机床逻辑有错误：死循环、除以零或数组下标越界", remedy: "在文本指出的位置更正 PLC 程序，然后重新启动" },
    de: { text: "Das SPS-Programm hat einen Fehler", cause: "Die Logik der Maschine hat einen Fehler: eine Endlosschleife, eine Division durch null oder einen Index außerhalb seines Feldes", remedy: "Das SPS-Programm an der Stelle im Text berichtigen und neu starten" },
  },
  132: {
    en: { text: "An auxiliary function (M, S or T) was not executed", cause: "The PLC refused the function, or its answer did not come in time", remedy: "Check what the function waits for (door, clamping, pressure, magazine), then reset and repeat the block" },
    zh: { text: "辅助功能 (M、S 或 T) 没有执行", cause: "PLC 拒绝该功能，或没有及时应答", remedy: "检查该功能等待的条件（门、夹紧、压力、刀库），然后复位并重新执行该程序段" },
    de: { text: "Eine Hilfsfunktion (M, S oder T) wurde nicht ausgeführt", cause: "Die SPS hat die Funktion abgelehnt, oder ihre Antwort kam nicht rechtzeitig", remedy: "Prüfen, worauf die Funktion wartet (Tür, Spannung, Druck, Magazin), dann zurücksetzen und den Satz wiederholen" },
  },
  133: {
    en: { text: "The PLC does not respond", cause: "The PLC service has ended or does not answer", remedy: "Wait for its restart, then reset; check the service in Diagnosis if it comes back" },
    zh: { text: "PLC 没有应答", cause: "PLC 服务已结束或没有应答", remedy: "等待其重新启动，然后复位；若再次出现，在诊断中检查该服务" },
    de: { text: "Die SPS antwortet nicht", cause: "Der Dienst der SPS ist beendet oder antwortet nicht", remedy: "Auf seinen Neustart warten, dann zurücksetzen; kommt der Alarm wieder, den Dienst in Diagnose prüfen" },
  },
  134: {
    en: { text: "Values of the PLC are forced", cause: "An operator has forced inputs, outputs or variables of the PLC; the programs cannot change them", remedy: "Release them with 'trunnion plc force --release' when the test is over" },
    zh: { text: "PLC 的值被强制", cause: "操作员强制了 PLC 的输入、输出或变量；程序无法更改它们", remedy: "测试结束后用 'trunnion plc force --release' 释放" },
    de: { text: "Werte der SPS sind gesetzt (Forcen)", cause: "Ein Bediener hat Eingänge, Ausgänge oder Variablen der SPS gesetzt; die Programme können sie nicht ändern", remedy: "Nach dem Test mit 'trunnion plc force --release' freigeben" },
  },
  135: {
    en: { text: "A Modbus device does not answer", cause: "The device is off, its cable or address is wrong, or it refuses a request; its inputs have their values for the loss of the connection", remedy: "Check the device, its cable and the address in modbus.yaml; when it answers again, reset" },
    zh: { text: "某个 Modbus 设备没有应答", cause: "设备断电、电缆或地址错误，或设备拒绝请求；其输入为连接中断时的规定值", remedy: "检查设备、电缆和 modbus.yaml 中的地址；恢复应答后复位" },
    de: { text: "Ein Modbus-Gerät antwortet nicht", cause: "Das Gerät ist aus, sein Kabel oder seine Adresse ist falsch, oder es lehnt eine Anfrage ab; seine Eingänge haben die Werte für den Verlust der Verbindung", remedy: "Das Gerät, sein Kabel und die Adresse in modbus.yaml prüfen; wenn es wieder antwortet, zurücksetzen" },
  },
  136: {
    en: { text: "The machine reports", cause: "The PLC program shows a message of messages.yaml that stops nothing", remedy: "Do what the text says; the message ends with its cause" },
    zh: { text: "机床提示", cause: "PLC 程序显示 messages.yaml 中的一条不停机的信息", remedy: "按文本处理；原因消失后信息自动结束" },
    de: { text: "Die Maschine meldet", cause: "Das SPS-Programm zeigt eine Meldung aus messages.yaml, die nichts anhält", remedy: "Tun, was der Text sagt; die Meldung endet mit ihrer Ursache" },
  },
  137: {
    en: { text: "The machine holds the channels", cause: "The PLC program shows a message of messages.yaml with the reaction feed_hold", remedy: "Do what the text says, then reset" },
    zh: { text: "机床使通道保持", cause: "PLC 程序显示 messages.yaml 中反应为 feed_hold 的信息", remedy: "按文本处理，然后复位" },
    de: { text: "Die Maschine hält die Kanäle an", cause: "Das SPS-Programm zeigt eine Meldung aus messages.yaml mit der Reaktion feed_hold", remedy: "Tun, was der Text sagt, dann zurücksetzen" },
  },
  138: {
    en: { text: "The machine stops the axes", cause: "The PLC program shows a message of messages.yaml with the reaction axis_stop", remedy: "Do what the text says, then reset" },
    zh: { text: "机床停止各轴", cause: "PLC 程序显示 messages.yaml 中反应为 axis_stop 的信息", remedy: "按文本处理，然后复位" },
    de: { text: "Die Maschine hält die Achsen an", cause: "Das SPS-Programm zeigt eine Meldung aus messages.yaml mit der Reaktion axis_stop", remedy: "Tun, was der Text sagt, dann zurücksetzen" },
  },
  139: {
    en: { text: "The gateway has ended or does not respond; the machine runs on without its page", cause: "The process has ended, was killed or is blocked; machine.yaml has 'gateway_loss: continue_with' and names the inputs that still hold and stop", remedy: "Use the panel; wait for the restart by the launcher, then reset the alarm; if it comes back, read the log of the gateway" },
    zh: { text: "网关已结束或没有应答；机床在没有页面的情况下继续运行", cause: "进程已结束、被终止或阻塞；machine.yaml 中设有 'gateway_loss: continue_with'，并列出仍可进给保持和急停的输入", remedy: "使用操作面板；等待启动器重启该服务，然后复位报警；如果再次出现，查看网关的日志" },
    de: { text: "Das Gateway ist beendet oder antwortet nicht; die Maschine läuft ohne ihre Seite weiter", cause: "Der Prozess ist beendet, abgebrochen oder blockiert; machine.yaml hat 'gateway_loss: continue_with' und nennt die Eingänge, die weiterhin halten und stoppen", remedy: "Die Bedientafel benutzen; auf den Neustart warten, dann den Alarm zurücksetzen; kommt er wieder, das Log des Gateways lesen" },
  },
  140: {
    en: { text: "The move would exceed the travel of an axis", cause: "Position, work offset or tool length lead beyond the software limits (10a006, 10a007)", remedy: "Compare position and limits in the text; correct the program, the work offset or the tool length" },
    zh: { text: "该运动将超过轴的行程", cause: "位置、工件偏置或刀具长度超出软件限位（10a006、10a007）", remedy: "比较文本中的位置和限位；更正程序、工件偏置或刀具长度" },
    de: { text: "Die Bewegung würde den Verfahrweg einer Achse überschreiten", cause: "Position, Nullpunktverschiebung oder Werkzeuglänge führen über die Softwaregrenzen hinaus (10a006, 10a007)", remedy: "Position und Grenzen im Text vergleichen; Programm, Nullpunktverschiebung oder Werkzeuglänge berichtigen" },
  },
  141: {
    en: { text: "The program is not stored", cause: "The program was deleted, renamed or never stored", remedy: "Store the program, or select another one" },
    zh: { text: "程序没有存储", cause: "程序已被删除、重命名或从未存储", remedy: "存储该程序，或选择其他程序" },
    de: { text: "Das Programm ist nicht gespeichert", cause: "Das Programm wurde gelöscht, umbenannt oder nie gespeichert", remedy: "Das Programm speichern oder ein anderes wählen" },
  },
  142: {
    en: { text: "The kinematic parameters are invalid", cause: "The parameters describe no possible kinematic chain", remedy: "Correct the parameters 04c400 to 04c988, then reset the channel" },
    zh: { text: "运动学参数无效", cause: "参数不能构成可行的运动链", remedy: "更正参数 04c400 至 04c988，然后复位通道" },
    de: { text: "Die Kinematikparameter sind ungültig", cause: "Die Parameter beschreiben keine mögliche kinematische Kette", remedy: "Die Parameter 04c400 bis 04c988 berichtigen, dann den Kanal zurücksetzen" },
  },
  143: {
    en: { text: "The machine is not ready", cause: "A service is not active yet, or an axis has no reference", remedy: "Wait until the cluster is ready; the text names what is missing" },
    zh: { text: "机床没有就绪", cause: "某个服务尚未运行，或某个轴没有参考点", remedy: "等待集群就绪；文本指出所缺的条件" },
    de: { text: "Die Maschine ist nicht bereit", cause: "Ein Dienst ist noch nicht aktiv, oder eine Achse hat keine Referenz", remedy: "Warten, bis das Cluster bereit ist; der Text nennt, was fehlt" },
  },
  144: {
    en: { text: "The program was interrupted", cause: "The drives were switched off or a process ended while the program ran", remedy: "Remove the cause and press cycle start; after an emergency stop reset and start from the line that is offered" },
    zh: { text: "程序被中断", cause: "程序运行时驱动器断电，或某个进程结束", remedy: "排除原因并按循环启动；急停之后先复位，再从所提示的行启动" },
    de: { text: "Das Programm wurde unterbrochen", cause: "Während des Programms wurden die Antriebe ausgeschaltet, oder ein Prozess endete", remedy: "Die Ursache beheben und Zyklusstart drücken; nach einem Not-Halt zurücksetzen und von der angebotenen Zeile starten" },
  },
  145: {
    en: { text: "A kinematic parameter is not a finite number", cause: "A kinematic parameter is infinite or not a number", remedy: "Correct the parameter in the text, then reset the channel" },
    zh: { text: "某个运动学参数不是有限数", cause: "某个运动学参数为无穷大或不是数", remedy: "更正文本中的参数，然后复位通道" },
    de: { text: "Ein Kinematikparameter ist keine endliche Zahl", cause: "Ein Kinematikparameter ist unendlich oder keine Zahl", remedy: "Den Parameter im Text berichtigen, dann den Kanal zurücksetzen" },
  },
  146: {
    en: { text: "A direction vector of the kinematic parameters is zero", cause: "A direction of a rotary or linear axis has no length", remedy: "Enter the direction of the axis in the parameter in the text, then reset the channel" },
    zh: { text: "运动学参数中的某个方向向量为零", cause: "旋转轴或直线轴的方向长度为零", remedy: "在文本中的参数内输入该轴的方向，然后复位通道" },
    de: { text: "Ein Richtungsvektor der Kinematikparameter ist null", cause: "Die Richtung einer Rund- oder Linearachse hat keine Länge", remedy: "Die Richtung der Achse in den Parameter im Text eingeben, dann den Kanal zurücksetzen" },
  },
  147: {
    en: { text: "The rotary axes are parallel", cause: "No two rotary axes differ in direction by 0.6 degrees", remedy: "Correct the directions of the rotary axes, then reset the channel" },
    zh: { text: "旋转轴相互平行", cause: "没有两个旋转轴的方向相差 0.6 度以上", remedy: "更正旋转轴的方向，然后复位通道" },
    de: { text: "Die Rundachsen sind parallel", cause: "Keine zwei Rundachsen unterscheiden sich in ihrer Richtung um 0,6 Grad", remedy: "Die Richtungen der Rundachsen berichtigen, dann den Kanal zurücksetzen" },
  },
  148: {
    en: { text: "A direction vector of the kinematic parameters is not a unit vector and is normalized", cause: "The length of a direction differs from 1 by more than 0.0001", remedy: "No action is necessary; enter a unit vector to end the warning" },
    zh: { text: "运动学参数中的某个方向向量不是单位向量，已归一化", cause: "某个方向的长度与 1 相差超过 0.0001", remedy: "无需处理；输入单位向量后警告结束" },
    de: { text: "Ein Richtungsvektor der Kinematikparameter ist kein Einheitsvektor und wird normiert", cause: "Die Länge einer Richtung weicht um mehr als 0,0001 von 1 ab", remedy: "Nichts ist zu tun; ein eingegebener Einheitsvektor beendet die Warnung" },
  },
  149: {
    en: { text: "The compensation parameters are invalid", cause: "A compensation table has no range, too many values or values beyond its limits", remedy: "Correct the table in the text, then reset the channel" },
    zh: { text: "补偿参数无效", cause: "补偿表没有范围、数值过多或数值超出限值", remedy: "更正文本中的表，然后复位通道" },
    de: { text: "Die Kompensationsparameter sind ungültig", cause: "Eine Kompensationstabelle hat keinen Bereich, zu viele Werte oder Werte außerhalb ihrer Grenzen", remedy: "Die Tabelle im Text berichtigen, dann den Kanal zurücksetzen" },
  },
  150: {
    en: { text: "A file could not be written", cause: "The disk is full, read-only or defective", remedy: "Make space on the disk or replace it; what was changed meanwhile is not stored" },
    zh: { text: "文件无法写入", cause: "磁盘已满、只读或损坏", remedy: "腾出磁盘空间或更换磁盘；其间的更改没有存储" },
    de: { text: "Eine Datei konnte nicht geschrieben werden", cause: "Der Datenträger ist voll, schreibgeschützt oder defekt", remedy: "Platz schaffen oder den Datenträger ersetzen; was inzwischen geändert wurde, ist nicht gespeichert" },
  },
  151: {
    en: { text: "The program shows a message to the operator", cause: "The program has a message for the operator", remedy: "Do what the message says, then press cycle start" },
    zh: { text: "程序向操作者显示信息", cause: "程序给操作员显示一条信息", remedy: "按信息处理，然后按循环启动" },
    de: { text: "Das Programm zeigt dem Bediener eine Meldung", cause: "Das Programm hat eine Meldung für den Bediener", remedy: "Tun, was die Meldung sagt, dann Zyklusstart drücken" },
  },
  152: {
    en: { text: "The program could not change a table", cause: "A value of G10 or of a system variable is beyond its limits, the role of who entered the line or stored the program does not permit the change, or the table's service does not answer", remedy: "Correct the value in the line of the text, or let a user of the role that it names store the program; then start again" },
    zh: { text: "程序无法更改表格", cause: "G10 或系统变量的值超出限值，输入该行或保存该程序的用户的角色不允许此更改，或该表的服务没有应答", remedy: "更正文本所指行中的值，或由具有所指角色的用户保存该程序；然后重新启动" },
    de: { text: "Das Programm konnte eine Tabelle nicht ändern", cause: "Ein Wert von G10 oder einer Systemvariablen liegt außerhalb seiner Grenzen, die Rolle dessen, der die Zeile eingegeben oder das Programm gespeichert hat, erlaubt die Änderung nicht, oder der Dienst der Tabelle antwortet nicht", remedy: "Den Wert in der Zeile des Textes berichtigen, oder das Programm von einem Benutzer der genannten Rolle speichern lassen; dann neu starten" },
  },
  153: {
    en: { text: "A file of the state directory is damaged; its previous generation is used", cause: "A power failure or a damaged disk", remedy: "Check the newest changes of the file in the text, then reset the alarm" },
    zh: { text: "状态目录中的某个文件已损坏；使用其上一版本", cause: "断电或磁盘损坏", remedy: "检查文本中文件的最近更改，然后复位报警" },
    de: { text: "Eine Datei des Zustandsverzeichnisses ist beschädigt; ihre vorige Fassung wird benutzt", cause: "Ein Stromausfall oder ein defekter Datenträger", remedy: "Die neuesten Änderungen der Datei im Text prüfen, dann den Alarm zurücksetzen" },
  },
  154: {
    en: { text: "A file of the state directory is damaged and cannot be used", cause: "The file and its previous generation are damaged", remedy: "Restore a backup, or enter the values again; then reset the alarm" },
    zh: { text: "状态目录中的某个文件已损坏，无法使用", cause: "该文件及其上一代均已损坏", remedy: "恢复备份，或重新输入数值；然后复位报警" },
    de: { text: "Eine Datei des Zustandsverzeichnisses ist beschädigt und nicht zu benutzen", cause: "Die Datei und ihre vorige Generation sind beschädigt", remedy: "Eine Sicherung zurückspielen oder die Werte neu eingeben; dann den Alarm zurücksetzen" },
  },
  155: {
    en: { text: "A stored program does not match its checksum", cause: "The file of the program was damaged or changed outside the control", remedy: "Upload the program again" },
    zh: { text: "存储的程序与其校验和不符", cause: "程序文件已损坏，或在控制系统之外被更改", remedy: "重新上传该程序" },
    de: { text: "Ein gespeichertes Programm passt nicht zu seiner Prüfsumme", cause: "Die Datei des Programms wurde beschädigt oder außerhalb der Steuerung geändert", remedy: "Das Programm erneut hochladen" },
  },
  156: {
    en: { text: "The certificate of HTTPS ends soon or has ended", cause: "A certificate holds for a limited time", remedy: "Make another with 'trunnion certificate MACHINE', or replace the file in the text; it is used within 2 s, without a restart" },
    zh: { text: "HTTPS 证书即将到期或已到期", cause: "证书有有效期限", remedy: "用 'trunnion certificate MACHINE' 生成新证书，或替换文本中的文件；2 秒内生效，无需重新启动" },
    de: { text: "Das Zertifikat von HTTPS läuft bald ab oder ist abgelaufen", cause: "Ein Zertifikat gilt für begrenzte Zeit", remedy: "Mit 'trunnion certificate MACHINE' ein neues erstellen oder die Datei im Text ersetzen; es gilt innerhalb von 2 s ohne Neustart" },
  },
  157: {
    en: { text: "The renewed certificate of HTTPS cannot be used; the one before stays in use", cause: "The certificate or its key is missing, damaged, out of its time, or they are not of one pair", remedy: "Read file and reason in the text, and put the right pair there; it is used within 2 s, without a restart" },
    zh: { text: "更新后的 HTTPS 证书无法使用；继续使用原证书", cause: "证书或其密钥缺失、损坏、过期，或两者不配对", remedy: "查看文本中的文件和原因，放入正确的一对；2 秒内生效，无需重新启动" },
    de: { text: "Das erneuerte Zertifikat von HTTPS ist nicht zu benutzen; das vorige bleibt in Gebrauch", cause: "Das Zertifikat oder sein Schlüssel fehlt, ist beschädigt oder abgelaufen, oder beide gehören nicht zusammen", remedy: "Datei und Grund im Text lesen und das richtige Paar dort ablegen; es gilt innerhalb von 2 s ohne Neustart" },
  },
  158: {
    en: { text: "A cycle of the program was not carried out", cause: "The cause in the text: an argument, the state of the machine, a process that ended, or no service for the cycle", remedy: "Remove the cause, reset, then start the program again; a measurement in it begins again" },
    zh: { text: "程序的循环没有执行", cause: "原因见文本：参数、机床状态、进程结束，或没有执行该循环的服务", remedy: "排除原因，复位，然后重新启动程序；其中的测量从头开始" },
    de: { text: "Ein Zyklus des Programms wurde nicht ausgeführt", cause: "Die Ursache im Text: ein Argument, der Zustand der Maschine, ein beendeter Prozess oder kein Dienst für den Zyklus", remedy: "Die Ursache beheben, zurücksetzen, dann das Programm neu starten; eine Messung darin beginnt von vorn" },
  },
  159: {
    en: { text: "Parameters of axes do not fit together", cause: "Saved parameters give an axis two letters, turn a travel round or couple a gantry wrongly", remedy: "Correct the parameter that the text names, reset a channel or start the control again, then reset the alarm" },
    zh: { text: "各轴的参数不匹配", cause: "已存储的参数给一个轴两个字母、颠倒了行程限位，或错误地耦合了龙门轴", remedy: "更正文本中的参数，复位一个通道或重新启动控制系统，然后复位报警" },
    de: { text: "Parameter von Achsen passen nicht zusammen", cause: "Gespeicherte Parameter geben einer Achse zwei Buchstaben, vertauschen die Grenzen eines Verfahrwegs oder koppeln einen Gantry falsch", remedy: "Den Parameter im Text berichtigen, einen Kanal zurücksetzen oder die Steuerung neu starten, dann den Alarm zurücksetzen" },
  },
  160: {
    en: { text: "A request was refused", cause: "The order was not possible in this state or had a value beyond its limits", remedy: "Read the reason in the text; nothing was changed" },
    zh: { text: "请求被拒绝", cause: "该命令在此状态下不可执行，或数值超出限值", remedy: "查看文本中的原因；没有任何更改" },
    de: { text: "Ein Befehl wurde abgelehnt", cause: "Der Befehl war in diesem Zustand nicht möglich oder hatte einen Wert außerhalb seiner Grenzen", remedy: "Den Grund im Text lesen; es wurde nichts geändert" },
  },
  161: {
    en: { text: "The disk of a recording is almost full", cause: "The recording, or another program, fills the disk", remedy: "Delete files on the disk in the text, or stop the recording before it ends by itself; the warning ends when there is space again" },
    zh: { text: "记录所在的磁盘几乎已满", cause: "记录或其他程序正在占满磁盘", remedy: "删除文本所指磁盘上的文件，或在记录自行结束之前停止记录；有空间后警告结束" },
    de: { text: "Die Festplatte einer Aufzeichnung ist fast voll", cause: "Die Aufzeichnung oder ein anderes Programm füllt die Festplatte", remedy: "Dateien auf der Festplatte im Text löschen oder die Aufzeichnung beenden, bevor sie von selbst endet; die Warnung endet, sobald wieder Platz ist" },
  },
  162: {
    en: { text: "A recording has ended because its file could not be continued", cause: "The disk is full, read-only or defective", remedy: "Keep the file, it can be read up to its end; make space on the disk in the text, reset the alarm and start a new recording" },
    zh: { text: "记录已结束，因为其文件无法继续写入", cause: "磁盘已满、只读或损坏", remedy: "保留该文件，它可读到末尾；在文本所指的磁盘上腾出空间，复位报警，然后开始新的记录" },
    de: { text: "Eine Aufzeichnung ist beendet, weil ihre Datei nicht weitergeschrieben werden konnte", cause: "Die Festplatte ist voll, schreibgeschützt oder defekt", remedy: "Die Datei behalten, sie ist bis zu ihrem Ende lesbar; auf der Festplatte im Text Platz schaffen, den Alarm zurücksetzen und neu aufzeichnen" },
  },
  170: {
    en: { text: "The program cannot be started at this line", cause: "The line is never reached, or lies inside a compensation or a curve that cannot be entered", remedy: "Choose an earlier line, or load the tool of the text by MDI and search again" },
    zh: { text: "程序无法从该行启动", cause: "该行永远不会执行到，或位于无法进入的刀补或曲线之中", remedy: "选择更前面的行，或用 MDI 换上文本中的刀具后重新搜索" },
    de: { text: "Das Programm kann in dieser Zeile nicht gestartet werden", cause: "Die Zeile wird nie erreicht, oder sie liegt in einer Korrektur oder Kurve, in die nicht eingestiegen werden kann", remedy: "Eine frühere Zeile wählen, oder das Werkzeug im Text durch MDI einwechseln und neu suchen" },
  },
  171: {
    en: { text: "The program is held at the selected line and waits for cycle start", cause: "The search has found the line", remedy: "Check that the approach is free, then press cycle start" },
    zh: { text: "程序停在所选的行，等待循环启动", cause: "搜索已找到该行", remedy: "确认接近路径无障碍，然后按循环启动" },
    de: { text: "Das Programm steht in der gewählten Zeile und wartet auf NC-Start", cause: "Die Suche hat die Zeile gefunden", remedy: "Prüfen, dass der Weg dorthin frei ist, dann Zyklusstart drücken" },
  },
  172: {
    en: { text: "The channel waits for program text", cause: "The program service or the network is too slow", remedy: "Wait; motion continues as soon as the text arrives" },
    zh: { text: "通道正在等待程序文本", cause: "程序服务或网络过慢", remedy: "请等待；文本到达后运动继续" },
    de: { text: "Der Kanal wartet auf Programmtext", cause: "Der Dienst program oder das Netz ist zu langsam", remedy: "Warten; die Bewegung geht weiter, sobald der Text kommt" },
  },
  173: {
    en: { text: "The control was switched off during a program", cause: "The power failed or the cluster was stopped while a program ran", remedy: "Start the program from the line that is offered" },
    zh: { text: "控制系统在程序运行期间被关闭", cause: "程序运行时断电，或集群被停止", remedy: "从所提示的行启动程序" },
    de: { text: "Die Steuerung wurde während eines Programms ausgeschaltet", cause: "Während eines Programms fiel der Strom aus, oder das Cluster wurde angehalten", remedy: "Das Programm von der angebotenen Zeile starten" },
  },
  174: {
    en: { text: "An axis did not reach its exact stop in time", cause: "The axis does not settle within its window: friction, load or too small a window", remedy: "Check the axis and the parameters of its exact stop; reset the alarm, then press cycle start" },
    zh: { text: "轴没有及时到达准停", cause: "轴不能稳定在其窗口内：摩擦、负载或窗口过小", remedy: "检查该轴及其准停参数；复位报警，然后按循环启动" },
    de: { text: "Eine Achse hat ihren Genauhalt nicht rechtzeitig erreicht", cause: "Die Achse kommt in ihrem Fenster nicht zur Ruhe: Reibung, Last oder ein zu kleines Fenster", remedy: "Die Achse und die Parameter ihres Genauhalts prüfen; den Alarm zurücksetzen, dann Zyklusstart drücken" },
  },
  175: {
    en: { text: "Bodies of the machine come too near to each other, and the motion continues", cause: "A move ahead leads two bodies of bodies.yaml within the clearance (collision: warn)", remedy: "Hold the feed; compare bodies, line and position in the text; correct the program, the tool table or bodies.yaml" },
    zh: { text: "机床部件相距过近，运动继续", cause: "前方的运动使 bodies.yaml 中的两个物体小于安全间距（collision: warn）", remedy: "进给保持；比较文本中的物体、行和位置；更正程序、刀具表或 bodies.yaml" },
    de: { text: "Körper der Maschine kommen einander zu nahe; die Bewegung geht weiter", cause: "Eine bevorstehende Bewegung bringt zwei Körper aus bodies.yaml näher als den Abstand (collision: warn)", remedy: "Vorschub anhalten; Körper, Zeile und Position im Text vergleichen; Programm, Werkzeugtabelle oder bodies.yaml berichtigen" },
  },
  176: {
    en: { text: "The motion stops before bodies of the machine meet", cause: "A move would lead two bodies of bodies.yaml within the clearance (collision: stop)", remedy: "Jog away: moves that increase the distance are allowed. Correct the program, the tool table or bodies.yaml, then start, or start from the line in the text" },
    zh: { text: "运动在机床部件相碰之前停止", cause: "某个运动将使 bodies.yaml 中的两个物体小于安全间距（collision: stop）", remedy: "手动移开：允许使间距增大的运动。更正程序、刀具表或 bodies.yaml，然后启动，或从文本中的行启动" },
    de: { text: "Die Bewegung hält an, bevor Körper der Maschine zusammenstoßen", cause: "Eine Bewegung würde zwei Körper aus bodies.yaml näher als den Abstand bringen (collision: stop)", remedy: "Von Hand wegfahren: Bewegungen, die den Abstand vergrößern, sind erlaubt. Programm, Werkzeugtabelle oder bodies.yaml berichtigen, dann starten, oder von der Zeile im Text starten" },
  },
  177: {
    en: { text: "The bodies of the machine cannot be used", cause: "bodies.yaml has an error, or does not fit the kinematic parameters; nothing moves while machine.yaml demands the check", remedy: "Correct the file in the text and start the machine again, or set 'collision: off' in machine.yaml" },
    zh: { text: "机床部件的数据无法使用", cause: "bodies.yaml 有错误，或与运动学参数不符；只要 machine.yaml 要求检查，轴就不会运动", remedy: "更正文本中的文件并重新启动机床，或在 machine.yaml 中设置 'collision: off'" },
    de: { text: "Die Körper der Maschine sind nicht zu benutzen", cause: "bodies.yaml hat einen Fehler oder passt nicht zu den Kinematikparametern; nichts bewegt sich, solange machine.yaml die Prüfung verlangt", remedy: "Die Datei im Text berichtigen und die Maschine neu starten, oder 'collision: off' in machine.yaml setzen" },
  },
  180: {
    en: { text: "The measurement of the kinematics was stopped", cause: "The cause in the text: the probe, a limit, an emergency stop, a process that ended, a result outside its tolerances, or an abort. No parameter was changed", remedy: "Remove the cause, reset the channel, move the probe off the sphere; then continue after the complete poses (trunnion calibrate continue) or start again" },
    zh: { text: "运动学测量被停止", cause: "原因见文本：测头、限位、急停、进程结束、结果超差或中止。参数没有更改", remedy: "排除原因，复位通道，将测头移离标准球；然后从已完成的位姿继续（trunnion calibrate continue）或重新开始" },
    de: { text: "Die Messung der Kinematik wurde angehalten", cause: "Die Ursache im Text: der Taster, eine Grenze, ein Not-Halt, ein beendeter Prozess, ein Ergebnis außerhalb der Toleranzen oder ein Abbruch. Kein Parameter wurde geändert", remedy: "Die Ursache beheben, den Kanal zurücksetzen, den Taster von der Kugel wegfahren; dann nach den vollständigen Posen fortsetzen (trunnion calibrate continue) oder neu beginnen" },
  },
  181: {
    en: { text: "A measured vector differs by more than its tolerance", cause: "A collision, a loose table or head, a sphere that has moved, or wrong inputs of the measurement", remedy: "Find the cause; measure again, discard the result, or confirm it when the change is right" },
    zh: { text: "测得的向量之差超过其公差", cause: "碰撞、工作台或摆头松动、标准球移动，或测量输入错误", remedy: "查明原因；重新测量、放弃结果，或在变化属实时确认结果" },
    de: { text: "Ein gemessener Vektor weicht stärker als seine Toleranz ab", cause: "Eine Kollision, ein loser Tisch oder Kopf, eine verschobene Kugel oder falsche Angaben zur Messung", remedy: "Die Ursache suchen; neu messen, das Ergebnis verwerfen, oder es bestätigen, wenn die Änderung stimmt" },
  },
  182: {
    en: { text: "A spindle does not turn because its acceleration cannot be computed", cause: "10a971 is 1, and the base speed 10a972 is 0 or above the power speed 10a973", remedy: "Enter both speeds from the data sheet of the motor, or 0 in 10a971; then reset" },
    zh: { text: "主轴不转动，因为无法计算其加速度", cause: "10a971 为 1，而基速 10a972 为 0 或大于功率转速 10a973", remedy: "按电机数据表输入两个转速，或将 10a971 设为 0；然后复位" },
    de: { text: "Eine Spindel dreht nicht, weil ihre Beschleunigung nicht berechnet werden kann", cause: "10a971 ist 1, und die Eckdrehzahl 10a972 ist 0 oder größer als die Leistungsdrehzahl 10a973", remedy: "Beide Drehzahlen aus dem Datenblatt des Motors eintragen, oder 0 in 10a971; dann zurücksetzen" },
  },
  183: {
    en: { text: "A spindle cannot be synchronized before its index mark has passed", cause: "The PLC asked for the synchronization of two spindles, and one of them has not passed its index mark since the start; its angle is not known", remedy: "Turn the spindle at a low speed for a revolution, let the PLC withdraw the request, reset, then ask again" },
    zh: { text: "主轴未经过零位标记，不能同步", cause: "PLC 请求两个主轴同步，但其中一个主轴自启动以来没有经过零位标记，角度未知", remedy: "以低速将该主轴转动一圈，由 PLC 撤销请求，复位，然后重新请求" },
    de: { text: "Eine Spindel kann nicht synchronisiert werden, bevor ihre Nullmarke überfahren ist", cause: "Die SPS hat die Synchronisierung zweier Spindeln verlangt, und eine davon hat seit dem Start ihre Nullmarke nicht überfahren; ihr Winkel ist nicht bekannt", remedy: "Die Spindel mit kleiner Drehzahl eine Umdrehung drehen, die Anforderung von der SPS zurücknehmen lassen, zurücksetzen, dann neu anfordern" },
  },
  184: {
    en: { text: "A spindle does not follow its master", cause: "The spindle is more than half a turn away from the angle of its master (overload, slip, too small a gain), or the synchronization is not possible: a path has one of the spindles (tapping), a master that does not exist or follows another spindle, or the drives went off before both were at rest", remedy: "Do what the text names; stop both spindles and open the chuck of one before they turn separately; then reset and ask again" },
    zh: { text: "主轴没有跟随其主导主轴", cause: "主轴偏离主导主轴的角度超过半圈（过载、打滑或增益太小），或无法同步：轨迹正在控制其中一个主轴（攻丝），主导主轴不存在，或它本身跟随另一主轴，或驱动器在两者静止之前已断电", remedy: "按文本处理；在两个主轴分别转动之前，停止两者并松开一个卡盘；然后复位并重新请求" },
    de: { text: "Eine Spindel folgt ihrer Leitspindel nicht", cause: "Die Spindel ist mehr als eine halbe Umdrehung vom Winkel ihrer Leitspindel entfernt (Überlast, Schlupf, zu kleine Verstärkung), oder die Synchronisierung ist nicht möglich: eine Bahn führt eine der Spindeln (Gewindebohren), die Leitspindel gibt es nicht, oder sie folgt selbst einer anderen, oder die Antriebe wurden abgeschaltet, bevor beide stillstanden", remedy: "Tun, was der Text nennt; beide Spindeln anhalten und ein Futter öffnen, bevor sie getrennt drehen; dann zurücksetzen und neu anfordern" },
  },
  185: {
    en: { text: "A spindle is not at the angle at which it is to be held", cause: "Something turns the spindle with more torque than its drive can hold, the spindle is blocked or does not slow down, its index mark does not pass, or the window 10a946 is too small", remedy: "Check that tool, tool changer and workpiece are free, what turns or blocks the spindle, and its encoder; reset, then orient it again" },
    zh: { text: "主轴不在应保持的定向角度", cause: "外力使主轴转动，其扭矩大于驱动器的保持扭矩；主轴被卡住、没有减速或没有经过零位标记；或窗口 10a946 过小", remedy: "检查刀具、换刀装置和工件是否自由，是什么使主轴转动或卡住，以及主轴编码器；复位，然后重新定向" },
    de: { text: "Eine Spindel steht nicht in dem Winkel, in dem sie gehalten werden soll", cause: "Etwas dreht die Spindel mit mehr Moment, als ihr Antrieb halten kann, sie ist blockiert oder wird nicht langsamer, ihre Nullmarke wird nicht überfahren, oder das Fenster 10a946 ist zu klein", remedy: "Prüfen, ob Werkzeug, Werkzeugwechsler und Werkstück frei sind, was die Spindel dreht oder blockiert, und ihren Geber; zurücksetzen, dann erneut orientieren" },
  },
  186: {
    en: { text: "A thread was broken off because of the speed of the spindle", cause: "The spindle does not turn, or turned at less than 45 % or more than 160 % of S, faster than an axis can follow, or the other way round while a thread was cut; or its index mark did not pass before the thread", remedy: "Retract the tool; check spindle, override and S; cut the thread again from its start point" },
    zh: { text: "螺纹加工因主轴转速而中断", cause: "主轴没有旋转，或在切削螺纹时转速低于 S 的 45%、高于 160%、快于轴所能跟随的速度，或方向相反；或螺纹前未经过零位标记", remedy: "退出刀具；检查主轴、倍率和 S；从起点重新切削螺纹" },
    de: { text: "Ein Gewinde wurde wegen der Drehzahl der Spindel abgebrochen", cause: "Die Spindel dreht sich nicht, oder sie drehte sich beim Gewindeschneiden mit weniger als 45 % oder mehr als 160 % von S, schneller, als eine Achse folgen kann, oder in der anderen Richtung; oder ihre Nullmarke wurde vor dem Gewinde nicht überfahren", remedy: "Das Werkzeug freifahren; Spindel, Override und S prüfen; das Gewinde vom Startpunkt neu schneiden" },
  },
  483: {
    en: { text: "The partner of a gantry axis has an alarm of its drive", cause: "The drive of the other side of the gantry has stopped, and this one with it (10a943)", remedy: "Remove the cause at the axis of alarm 114, then reset" },
    zh: { text: "龙门轴的另一侧驱动器有报警", cause: "龙门另一侧的驱动器已停止，本侧随之停止（10a943）", remedy: "在报警 114 所指的轴上排除原因，然后复位" },
    de: { text: "Der Partner einer Gantry-Achse hat einen Alarm seines Antriebs", cause: "Der Antrieb der anderen Seite der Gantry hat angehalten, und dieser mit ihm (10a943)", remedy: "Die Ursache an der Achse des Alarms 114 beheben, dann zurücksetzen" },
  },
};

/** The alarms of the NC language, whose texts name place and cause: what the operator does, by the language. */
export const languageAlarms: { first: number; last: number; remedy: Readonly<Record<string, string>> } = {
  first: 1000,
  last: 1999,
  remedy: {
    en: "Correct the line that the text names, then start again.",
    zh: "修改文本所指的程序行，然后重新启动。",
    de: "Die im Text genannte Zeile berichtigen, dann neu starten.",
  },
};
