/* Thymios whose machine is Aseba's own (Debian: libasebavm.a, libasebavmbuffer.a), as a library for ctypes. Variables and
   events are those of the emulated robot; time is the caller's. */

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <common/consts.h>
#include <common/types.h>
#include <vm/vm.h>
#include <vm/natives.h>
#include <transport/buffer/vm-buffer.h>

enum { PROGRAM = 1534, VARIABLES = 600, STACK = 32, LARGEST = 1024 };

typedef struct {
    AsebaVMState vm; /* first: its address is that of the node */
    uint16_t bytecode[PROGRAM];
    int16_t variables[VARIABLES], stack[STACK];
    uint16_t source, length;
    uint8_t incoming[LARGEST];
    void (*send)(uint16_t node, const uint8_t *data, uint16_t length);
} Node;

static AsebaVMDescription *description;
static AsebaLocalEventDescription *events;
static const AsebaNativeFunctionDescription *natives[] = {0};

/* Names of variables with their sizes, and of events; the arrays end with a null pointer. */
void describe(const char **names, const uint16_t *sizes, const char **event_names) {
    int count = 0;
    while (names[count]) count++;
    description = calloc(1, sizeof *description + (count + 1) * sizeof(AsebaVariableDescription));
    description->name = "thymio-II";
    for (int i = 0; i < count; i++)
        description->variables[i] = (AsebaVariableDescription){sizes[i], strdup(names[i])};
    for (count = 0; event_names[count]; count++) {}
    events = calloc(count + 1, sizeof *events);
    for (int i = 0; i < count; i++)
        events[i] = (AsebaLocalEventDescription){strdup(event_names[i]), ""};
}

Node *make(uint16_t number, void (*send)(uint16_t, const uint8_t *, uint16_t)) {
    Node *node = calloc(1, sizeof *node);
    node->vm = (AsebaVMState){.nodeId = number, .bytecodeSize = PROGRAM, .bytecode = node->bytecode,
                              .variablesSize = VARIABLES, .variables = node->variables,
                              .stackSize = STACK, .stack = node->stack};
    node->send = send;
    AsebaVMInit(&node->vm);
    return node;
}

int16_t *variables(Node *node) { return node->variables; }

/* A message: its type and data. */
void receive(Node *node, uint16_t source, const uint8_t *data, uint16_t length) {
    node->source = source;
    node->length = length;
    memcpy(node->incoming, data, length);
    AsebaProcessIncomingEvents(&node->vm);
    AsebaVMRun(&node->vm, 1000);
}

/* A local event, as a Thymio's main loop starts it. */
void event(Node *node, uint16_t number) {
    if (AsebaMaskIsSet(node->vm.flags, ASEBA_VM_STEP_BY_STEP_MASK) &&
        AsebaMaskIsSet(node->vm.flags, ASEBA_VM_EVENT_ACTIVE_MASK))
        return;
    AsebaVMSetupEvent(&node->vm, ASEBA_EVENT_LOCAL_EVENTS_START - number);
    AsebaVMRun(&node->vm, 1000);
}

/* A Thymio clears its variables in this callback, which switches its motors off. */
void AsebaVMResetCB(AsebaVMState *vm) { memset(vm->variables, 0, vm->variablesSize * sizeof *vm->variables); }
void AsebaVMRunCB(AsebaVMState *vm) {}
void AsebaVMErrorCB(AsebaVMState *vm, const char *message) {}

void AsebaSendBuffer(AsebaVMState *vm, const uint8_t *data, uint16_t length) {
    ((Node *)vm)->send(vm->nodeId, data, length);
}

uint16_t AsebaGetBuffer(AsebaVMState *vm, uint8_t *data, uint16_t most, uint16_t *source) {
    Node *node = (Node *)vm;
    uint16_t length = node->length <= most ? node->length : 0;
    memcpy(data, node->incoming, length);
    *source = node->source;
    node->length = 0;
    return length;
}

const AsebaVMDescription *AsebaGetVMDescription(AsebaVMState *vm) { return description; }
const AsebaLocalEventDescription *AsebaGetLocalEventsDescriptions(AsebaVMState *vm) { return events; }
const AsebaNativeFunctionDescription *const *AsebaGetNativeFunctionsDescriptions(AsebaVMState *vm) { return natives; }
void AsebaNativeFunction(AsebaVMState *vm, uint16_t id) {}
void AsebaWriteBytecode(AsebaVMState *vm) {}
void AsebaResetIntoBootloader(AsebaVMState *vm) {}
void AsebaPutVmToSleep(AsebaVMState *vm) {}
void AsebaAssert(AsebaVMState *vm, int reason) { abort(); }
