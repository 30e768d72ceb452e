@echo off
rem Windows: double-click to play.
cd /d "%~dp0"
where py >nul 2>nul && (py -3 main.py %* & goto end)
where python >nul 2>nul && (python main.py %* & goto end)
echo PiGaming needs Python 3.11 or newer: install it from https://www.python.org/downloads/ and double-click again.
pause
exit /b 2
:end
if errorlevel 1 pause
