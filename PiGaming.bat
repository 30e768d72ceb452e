@echo off
rem Windows: double-click to play. Python is tried out, since Windows has a "python" that only opens its shop.
cd /d "%~dp0"
for %%p in ("py -3" python) do %%~p -c "import sys; sys.exit(sys.version_info < (3, 11))" >nul 2>nul && set "python=%%~p" && goto play
echo PiGaming needs Python 3.11 or newer: install it from https://www.python.org/downloads/ and double-click again.
pause
exit /b 2
:play
%python% main.py %*
set "code=%errorlevel%"
if not "%code%"=="0" pause
exit /b %code%
