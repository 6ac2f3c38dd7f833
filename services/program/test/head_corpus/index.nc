e﻿%9990.9(homing)
